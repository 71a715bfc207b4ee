"""What one connection may bring without a message coming of it, and who may open one. No sockets inside."""
# SPDX-License-Identifier: Apache-2.0
import math
import threading
from typing import Dict, List, Mapping, NamedTuple, Tuple

# What is wrong with a connection.
TOO_MANY = "too many at once"
TOO_SOON = "again too soon"


class Allowance(NamedTuple):
    """Of one port.

    Attributes:
        burst_bytes: that a connection may bring at once beyond its messages: parts of an endless one, subscriptions.
        bytes_per_s: that it may bring beyond them for ever: heartbeats, headers.
        connections: at once.
        pause_s: for which an address opens no new one after one of its connections had to be cut off.
        overhead_bytes: of each frame of a message that has arrived, at least; what it took on the line beside its data.
        check_period_s: from one look at the connections to the next; what one brings meanwhile is in memory.
    """

    burst_bytes: float
    bytes_per_s: float
    connections: int
    pause_s: float
    overhead_bytes: int
    check_period_s: float


# ZeroMQ keeps 64 bytes for a frame of 2: the burst becomes 8 MiB at most.
COMMAND_BURST_BYTES = 256 * 1024
# A subscription of 5 bytes on the line takes some 200 in ZeroMQ's tree; applications have one.
STATUS_BURST_BYTES = 16 * 1024
# Heartbeats are some 100 bytes a second.
IDLE_BYTES_PER_S = 2048.0
MAX_CONNECTIONS = 100
# Who floods connects anew at once, some hundred times a second.
PAUSE_S = 1.0
# On the loopback interface a flood of parts brings some 20 MB in this time, one of subscriptions 3 MB, which are 70 to
# 110 MB in ZeroMQ's tree; in a fifth of it they are 15 to 30 MB (24 November 2026).
COMMAND_CHECK_PERIOD_S, STATUS_CHECK_PERIOD_S = 0.05, 0.01
# Of ZMTP 3 (RFC 23), and of a CURVE message (RFC 26): its name, nonce, authenticator and flags besides.
PLAIN_FRAME_BYTES, CURVE_FRAME_BYTES = 2, 35


def allowances(is_encrypted: bool) -> Tuple[Allowance, Allowance]:
    """Of the port of Status and of that of Commands."""
    frame_bytes = CURVE_FRAME_BYTES if is_encrypted else PLAIN_FRAME_BYTES
    return (Allowance(STATUS_BURST_BYTES, IDLE_BYTES_PER_S, MAX_CONNECTIONS, PAUSE_S, frame_bytes,
                      STATUS_CHECK_PERIOD_S),
            Allowance(COMMAND_BURST_BYTES, IDLE_BYTES_PER_S, MAX_CONNECTIONS, PAUSE_S, frame_bytes,
                      COMMAND_CHECK_PERIOD_S))


class _Account:
    """One connection: its address, the bytes that became messages, and those that were forgiven."""

    def __init__(self, address: str, now_s: float) -> None:
        self.address, self.seen_s = address, now_s
        self.delivered = self.forgiven = 0.0


class PeerLimits:
    """Thread-safe: one thread reads the counters, another takes the messages.

    A connection is any number of its own, as its file descriptor.
    """

    def __init__(self, allowance: Allowance):
        self._allowance = allowance
        self._accounts: Dict[int, _Account] = {}
        self._paused: Dict[str, float] = {}
        self._lock = threading.Lock()

    @property
    def check_period_s(self) -> float:
        """See Allowance."""
        return self._allowance.check_period_s

    def open(self, connection: int, address: str, now_s: float) -> str:
        """Note a new connection; why it is to be cut off, empty for one that may stay."""
        with self._lock:
            self._accounts[connection] = _Account(address, now_s)
            if now_s - self._paused.get(address, -math.inf) < self._allowance.pause_s:
                return TOO_SOON
            return "" if len(self._accounts) <= self._allowance.connections else TOO_MANY

    def close(self, connection: int) -> None:
        """Forget a connection."""
        with self._lock:
            self._accounts.pop(connection, None)

    def delivered(self, connection: int, frames: int, size_bytes: int) -> None:
        """A message of a connection has arrived."""
        with self._lock:
            account = self._accounts.get(connection)
            if account is not None:
                account.delivered += size_bytes + frames * self._allowance.overhead_bytes

    def excessive(self, received_bytes: Mapping[int, int], now_s: float) -> List[int]:
        """Connections that have brought too much, by all that each has brought, at a time of the steady clock."""
        with self._lock:
            found = [connection for connection, received in received_bytes.items()
                     if self._is_excessive(connection, received, now_s)]
            self._paused = {address: since_s for address, since_s in self._paused.items()
                            if now_s - since_s < self._allowance.pause_s}
            self._paused.update((self._accounts[connection].address, now_s) for connection in found)
            return found

    def _is_excessive(self, connection: int, received: int, now_s: float) -> bool:
        account = self._accounts.get(connection)
        if account is None:
            return False
        owed = received - account.delivered - account.forgiven
        # A message may be taken before the counter is read that counts it: nothing is forgiven in advance.
        account.forgiven += min(max(owed, 0.0), (now_s - account.seen_s) * self._allowance.bytes_per_s)
        account.seen_s = now_s
        return received - account.delivered - account.forgiven > self._allowance.burst_bytes
