"""Limits of the connections of a port, and of the bytes of each beyond its complete messages. No sockets inside."""
# SPDX-License-Identifier: Apache-2.0
import math
import threading
from typing import Dict, List, Mapping, NamedTuple, Tuple

# Causes for cutting off a new connection.
TOO_MANY = "too many at once"
TOO_SOON = "again too soon"


class Allowance(NamedTuple):
    """Limits of one port.

    Attributes:
        burst_bytes: bytes that a connection may bring at once beyond its messages: unfinished messages,
            subscriptions.
        bytes_per_s: rate at which it may continuously bring bytes beyond its messages: heartbeats, headers.
        connections: maximum number of simultaneous connections.
        pause_s: time for which an address may not connect again after one of its connections was cut off.
        overhead_bytes: least bytes on the line per frame of a complete message in addition to its data.
        check_period_s: period of the check; what a connection brings within it is already in memory.
    """

    burst_bytes: float
    bytes_per_s: float
    connections: int
    pause_s: float
    overhead_bytes: int
    check_period_s: float


# ZeroMQ allocates 64 bytes for a frame of 2 bytes, so the burst becomes at most 8 MiB.
COMMAND_BURST_BYTES = 256 * 1024
# A subscription of 5 bytes on the line needs about 200 bytes in ZeroMQ's tree; an application has one.
STATUS_BURST_BYTES = 16 * 1024
# Heartbeats need about 100 bytes a second.
IDLE_BYTES_PER_S = 2048.0
MAX_CONNECTIONS = 100
# A flooding peer reconnects immediately, several hundred times a second.
PAUSE_S = 1.0
# On the loopback interface a flood of parts brings about 20 MB in 50 ms, and a flood of subscriptions 3 MB. The
# subscriptions need 70 to 110 MB in ZeroMQ's tree, and 15 to 30 MB for 10 ms (24 November 2026).
COMMAND_CHECK_PERIOD_S, STATUS_CHECK_PERIOD_S = 0.05, 0.01
# Frame overhead of ZMTP 3 (RFC 23), and of a CURVE message (RFC 26) with its name, nonce, authenticator and flags.
PLAIN_FRAME_BYTES, CURVE_FRAME_BYTES = 2, 35


def allowances(is_encrypted: bool) -> Tuple[Allowance, Allowance]:
    """Return the limits of the Status port and of the Command port."""
    frame_bytes = CURVE_FRAME_BYTES if is_encrypted else PLAIN_FRAME_BYTES
    return (Allowance(STATUS_BURST_BYTES, IDLE_BYTES_PER_S, MAX_CONNECTIONS, PAUSE_S, frame_bytes,
                      STATUS_CHECK_PERIOD_S),
            Allowance(COMMAND_BURST_BYTES, IDLE_BYTES_PER_S, MAX_CONNECTIONS, PAUSE_S, frame_bytes,
                      COMMAND_CHECK_PERIOD_S))


class _Account:
    """One connection: its address, the bytes of its complete messages, and the bytes that bytes_per_s has allowed."""

    def __init__(self, address: str, now_s: float) -> None:
        self.address, self.seen_s = address, now_s
        self.delivered = self.forgiven = 0.0


class PeerLimits:
    """Limits of the connections of one port. Thread-safe: one thread reads the counters, another receives the messages.

    A connection is identified by any unique number, such as its file descriptor.
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
        """Register a new connection and return why it has to be cut off, or an empty text."""
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
        """Count a complete message of a connection."""
        with self._lock:
            account = self._accounts.get(connection)
            if account is not None:
                account.delivered += size_bytes + frames * self._allowance.overhead_bytes

    def excessive(self, received_bytes: Mapping[int, int], now_s: float) -> List[int]:
        """Return the connections that have brought too much, by their total bytes, at a time of the steady clock."""
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
        # A message may be counted before the system's counter that includes it is read: allow nothing in advance.
        account.forgiven += min(max(owed, 0.0), (now_s - account.seen_s) * self._allowance.bytes_per_s)
        account.seen_s = now_s
        return received - account.delivered - account.forgiven > self._allowance.burst_bytes
