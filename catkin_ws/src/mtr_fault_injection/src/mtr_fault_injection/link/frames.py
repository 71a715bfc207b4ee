"""Splits the bytes of a ZeroMQ connection into frames (ZMTP 3, RFC 23), and applies faults to them. No sockets
inside."""
# SPDX-License-Identifier: Apache-2.0
import random
from typing import List, NamedTuple, Optional, Tuple

from ..parts import Kind
from ..schedule import Fault

GREETING_BYTES = 64
_LONG, _COMMAND = 0x02, 0x04
# On an encrypted connection a message is sent within a command of this name (RFC 26).
_ENCRYPTED_MESSAGE = b"\x07MESSAGE"


class Frame(NamedTuple):
    """Piece of a connection. is_message: it contains a message; a handshake or heartbeat does not."""

    data: bytes
    is_message: bool


class FrameCutter:
    """Splits one direction of one connection."""

    def __init__(self) -> None:
        self._rest, self._of_greeting = b"", GREETING_BYTES

    def feed(self, data: bytes) -> List[Frame]:
        """Return the completed frames; pieces of the greeting are returned at once, because each end waits for the
        other's first bytes."""
        greeting, data = data[:self._of_greeting], data[self._of_greeting:]
        self._of_greeting -= len(greeting)
        self._rest += data
        frames = [Frame(greeting, False)] if greeting else []
        while True:
            size = self._size()
            if size is None or len(self._rest) < size:
                return frames
            piece, self._rest = self._rest[:size], self._rest[size:]
            frames.append(Frame(piece, _is_message(piece)))

    def _size(self) -> Optional[int]:
        """Return the size of the next frame; None while it is unknown."""
        if not self._rest:
            return None
        start = _body_at(self._rest[0])
        if len(self._rest) < start:
            return None
        return start + int.from_bytes(self._rest[1:start], "big")


class FrameSpoiler:
    """Applies a fault to the frames of one direction."""

    def __init__(self, seed: int):
        self._random = random.Random(seed)
        self._held: Tuple[bytes, ...] = ()

    def passed(self, frame: Frame, fault: Optional[Fault]) -> List[bytes]:
        """Return the pieces to forward instead of a frame, in order; the caller applies delays."""
        kind = fault.kind if fault else None
        if kind is Kind.OFF:
            self._held = ()
            return []
        if kind is Kind.REORDER and frame.is_message:
            if not self._held:
                self._held = (frame.data,)
                return []
            held, self._held = self._held, ()
            return [frame.data, *held]
        held, self._held = self._held, ()
        if kind is Kind.LOSE and frame.is_message and fault and self._random.random() < fault.amount:
            return [*held]
        return [*held, frame.data, frame.data] if kind is Kind.DOUBLE and frame.is_message else [*held, frame.data]


def _body_at(flags: int) -> int:
    return 9 if flags & _LONG else 2


def _is_message(piece: bytes) -> bool:
    return not piece[0] & _COMMAND or piece.startswith(_ENCRYPTED_MESSAGE, _body_at(piece[0]))
