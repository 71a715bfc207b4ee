"""Frames of the rosserial protocol, revision 2: bytes to frames and back.

Little-endian: FF, FE, length u16, its check, topic id u16, payload, check. No escaping, so FF FE may occur in a
payload; a frame counts only when both checks agree. Source: rosserial 0.9, serial_node.py.
"""
# SPDX-License-Identifier: Apache-2.0
import struct
from typing import List, NamedTuple

SYNC = b"\xff\xfe"
# Second byte of a frame of protocol revision 1.
SYNC_REVISION_1 = b"\xff\xff"
HEADER = struct.Struct("<HBH")
HEADER_BYTES = len(SYNC) + HEADER.size
OVERHEAD_BYTES = HEADER_BYTES + 1
# rosserial's host reads the length as a signed number; no message of a microcontroller comes near.
MAX_PAYLOAD_BYTES = 4096


class SerialFrame(NamedTuple):
    """One message on the line."""

    topic_id: int
    payload: bytes


class FrameCounts(NamedTuple):
    """Counters of a parser since its start; skipped_bytes lie outside of good frames."""

    frames: int = 0
    skipped_bytes: int = 0
    checksum_errors: int = 0
    revision_1_syncs: int = 0


def encode(frame: SerialFrame) -> bytes:
    """Bytes of a frame; ValueError when its payload is too long."""
    if len(frame.payload) > MAX_PAYLOAD_BYTES:
        raise ValueError(f"A payload of {len(frame.payload)} bytes does not fit; allowed are {MAX_PAYLOAD_BYTES}.")
    header = HEADER.pack(len(frame.payload), length_check(len(frame.payload)), frame.topic_id)
    return b"".join((SYNC, header, frame.payload, bytes((payload_check(frame.topic_id, frame.payload),))))


def length_check(length: int) -> int:
    """Check of the two bytes of a length."""
    return 255 - (length % 256 + length // 256) % 256


def payload_check(topic_id: int, payload: bytes) -> int:
    """Check of topic id and payload."""
    return 255 - (topic_id % 256 + topic_id // 256 + sum(payload)) % 256


class FrameParser:
    """Takes bytes in pieces of any size and gives the good frames among them.

    After damage it looks for the next FF FE from the byte behind the bad one on, so that one flipped bit never costs a
    good frame that follows. A length that was damaged into a long one would hold up what follows it until so many bytes
    have come; MAX_PAYLOAD_BYTES bounds that, and a gap in the stream ends it at once (`forget`).
    """

    def __init__(self, max_payload_bytes: int = MAX_PAYLOAD_BYTES):
        self._max_payload_bytes = max_payload_bytes
        self._buffer = bytearray()
        self._frames = self._skipped = self._checksum_errors = self._revision_1 = 0

    @property
    def counts(self) -> FrameCounts:
        """Counters so far."""
        return FrameCounts(self._frames, self._skipped, self._checksum_errors, self._revision_1)

    @property
    def has_partial_frame(self) -> bool:
        """True while part of a frame is waiting for its rest."""
        return bool(self._buffer)

    def feed(self, data: bytes) -> List[SerialFrame]:
        """Frames that are complete now."""
        self._buffer += data
        found: List[SerialFrame] = []
        while self._seek():
            length, check, topic_id = HEADER.unpack_from(self._buffer, len(SYNC))
            if check != length_check(length) or length > self._max_payload_bytes:
                self._checksum_errors += 1
                self._skip(1)
                continue
            end = HEADER_BYTES + length
            if len(self._buffer) <= end:
                break
            payload = bytes(self._buffer[HEADER_BYTES:end])
            if self._buffer[end] == payload_check(topic_id, payload):
                found.append(SerialFrame(topic_id, payload))
                self._frames += 1
                del self._buffer[:end + 1]
            else:
                self._checksum_errors += 1
                self._skip(1)
        return found

    def forget(self) -> List[SerialFrame]:
        """The rest of a frame under way will not come, nor that of one inside what was taken for its payload, and so
        on: the good frames among all of it."""
        found: List[SerialFrame] = []
        while self._buffer:
            self._skip(1)
            found += self.feed(b"")
        return found

    def _seek(self) -> bool:
        """Drop what precedes the next FF FE; True when a whole header is there."""
        start = self._buffer.find(SYNC)
        if start < 0:
            start = len(self._buffer) - (1 if self._buffer.endswith(SYNC[:1]) else 0)
        self._revision_1 += self._buffer.count(SYNC_REVISION_1, 0, start)
        self._skip(start)
        return len(self._buffer) >= HEADER_BYTES

    def _skip(self, count: int) -> None:
        self._skipped += count
        del self._buffer[:count]
