"""The socket of pairing: plain TCP with four messages of fixed length, one connection at a time."""
# SPDX-License-Identifier: Apache-2.0
import socket
import time
from typing import Callable, NamedTuple, Optional

from mtr_core.errors import RobotError
from mtr_proto.keys import KeyPair
from mtr_proto.pairing import HELLO_BYTES, PROOF_BYTES, Hello, PairingError, RobotSide, WrongCode

from .authorised_keys import Role
from .pairing_window import PairingWindow

# Longest time of one connection from its acceptance on, unless the window closes earlier; a laptop needs 0.1 s.
CONNECTION_S = 5.0
# Connections that may wait meanwhile.
BACKLOG = 4


class PairingFailed(RobotError):
    """The socket cannot be opened."""


class Clock(NamedTuple):
    """The steady clock in s, and its wait function."""

    now_s: Callable[[], float] = time.monotonic
    wait: Callable[[float], None] = time.sleep


SYSTEM_CLOCK = Clock()


class Offer(NamedTuple):
    """Data for a laptop that proves it has the code: the robot's public key and a role."""

    code: str
    keys: KeyPair
    role: Role


class PairingServer:
    """Pairs one laptop.

    keep: stores the paired key, before the laptop receives its confirmation. say: shows a line at the robot.
    """

    def __init__(self, offer: Offer, keep: Callable[[Hello], None], say: Callable[[str], None],
                 clock: Clock = SYSTEM_CLOCK):
        self._offer, self._keep, self._say, self._clock = offer, keep, say, clock
        self._listener: Optional[socket.socket] = None

    def listen(self, address: str, port: int) -> int:
        """Open the socket and return its port, which the system chooses for 0. Raises PairingFailed with a sentence."""
        try:
            self._listener = socket.create_server((address, port), backlog=BACKLOG)
        except OSError as error:
            raise PairingFailed(f"Pairing cannot listen on {address} port {port}: {error.strerror}.") from None
        return int(self._listener.getsockname()[1])

    def run(self, window: PairingWindow) -> Optional[Hello]:
        """Wait until a laptop is paired and return its greeting, or None if the window closes."""
        if self._listener is None:
            raise PairingFailed("Pairing does not listen.")
        with self._listener as listener:
            while window.left_s(self._clock.now_s()) > 0.0:
                hello = self._next(listener, window)
                if hello is not None:
                    return hello
        return None

    def _next(self, listener: socket.socket, window: PairingWindow) -> Optional[Hello]:
        """Serve one connection, after the pause for wrong tries; return None also when the window closes meanwhile."""
        self._clock.wait(window.pause_s(self._clock.now_s()))
        left_s = window.left_s(self._clock.now_s())
        if not left_s:
            return None
        listener.settimeout(left_s)
        try:
            connection, peer = listener.accept()
        except OSError:
            # No connection came, or the peer closed it at once.
            return None
        with connection:
            return self._try(connection, str(peer[0]), window)

    def _try(self, connection: socket.socket, peer: str, window: PairingWindow) -> Optional[Hello]:
        now_s = self._clock.now_s()
        end_s = now_s + min(CONNECTION_S, window.left_s(now_s))
        try:
            side = RobotSide(self._offer.code, self._offer.keys.public)
            hello, answer = side.answer(self._received(connection, HELLO_BYTES, end_s))
            window.begin_try(self._clock.now_s())
            connection.sendall(answer)
            welcome = side.welcome(self._received(connection, PROOF_BYTES, end_s), self._offer.role.value)
        except WrongCode:
            self._say(f"Wrong code from {peer}, try {window.tries}.")
            return None
        except (PairingError, OSError) as error:
            window.strange += 1
            # Only the first one is reported, so that a flood does not fill the screen.
            if window.strange == 1:
                self._say(f"A connection from {peer} was no pairing: {error}")
            return None
        self._keep(hello)
        window.paired = True
        try:
            connection.sendall(welcome)
        except OSError:
            self._say("The laptop was gone before it heard the end; it is paired here. Pair it anew.")
        return hello

    def _received(self, connection: socket.socket, length: int, end_s: float) -> bytes:
        """Receive exactly this many bytes; raises OSError or PairingError."""
        data = b""
        while len(data) < length:
            left_s = end_s - self._clock.now_s()
            if left_s <= 0.0:
                raise PairingError("It was too slow.")
            connection.settimeout(left_s)
            part = connection.recv(length - len(data))
            if not part:
                raise PairingError("It has ended early.")
            data += part
        return data
