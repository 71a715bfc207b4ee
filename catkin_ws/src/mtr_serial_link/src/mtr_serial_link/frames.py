"""Frames of the rosserial protocol, revision 2: parser and encoder.

Little-endian: FF, FE, length u16, its check, topic id u16, payload, check. Bytes are not escaped, so FF FE may occur in
a payload; a frame is valid only if both checks match. Source: rosserial 0.9, serial_node.py.
"""
# SPDX-License-Identifier: Apache-2.0
import struct
from typing import List, NamedTuple

SYNC = b"\xff\xfe"
# Start bytes of protocol revision 1.
SYNC_REVISION_1 = b"\xff\xff"
HEADER = struct.Struct("<HBH")
HEADER_BYTES = len(SYNC) + HEADER.size
OVERHEAD_BYTES = HEADER_BYTES + 1
# Limit, because rosserial's host reads the length as a signed number; messages of microcontrollers are much shorter.
MAX_PAYLOAD_BYTES = 4096


class SerialFrame(NamedTuple):
    """One message on the line."""

    topic_id: int
    payload: bytes


class FrameCounts(NamedTuple):
    """Counters of a parser since its start; skipped_bytes are outside of valid frames."""

    frames: int = 0
    skipped_bytes: int = 0
    checksum_errors: int = 0
    revision_1_syncs: int = 0


def encode(frame: SerialFrame) -> bytes:
    """Return the bytes of a frame; ValueError if its payload is too long."""
    if len(frame.payload) > MAX_PAYLOAD_BYTES:
        raise ValueError(f"A payload of {len(frame.payload)} bytes does not fit; allowed are {MAX_PAYLOAD_BYTES}.")
    header = HEADER.pack(len(frame.payload), length_check(len(frame.payload)), frame.topic_id)
    return b"".join((SYNC, header, frame.payload, bytes((payload_check(frame.topic_id, frame.payload),))))


def length_check(length: int) -> int:
    """Return the check of the two length bytes."""
    return 255 - (length % 256 + length // 256) % 256


def payload_check(topic_id: int, payload: bytes) -> int:
    """Return the check of topic id and payload."""
    return 255 - (topic_id % 256 + topic_id // 256 + sum(payload)) % 256


class FrameParser:
    """Extracts valid frames from bytes in pieces of any size.

    After an error, the search for FF FE continues at the next byte, so that a flipped bit never costs a following valid
    frame. A corrupt length could delay the following frames until that many bytes have arrived. MAX_PAYLOAD_BYTES
    limits the delay, and a gap in the stream ends it at once (`forget`).
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
        """True while a frame is incomplete."""
        return bool(self._buffer)

    def feed(self, data: bytes) -> List[SerialFrame]:
        """Add bytes and return the completed frames."""
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
        """Give up an incomplete frame and return valid frames within its bytes.

        The same applies to incomplete frames nested in these bytes.
        """
        found: List[SerialFrame] = []
        while self._buffer:
            self._skip(1)
            found += self.feed(b"")
        return found

    def _seek(self) -> bool:
        """Drop everything before the next FF FE; return True if a complete header is available."""
        start = self._buffer.find(SYNC)
        if start < 0:
            start = len(self._buffer) - (1 if self._buffer.endswith(SYNC[:1]) else 0)
        self._revision_1 += self._buffer.count(SYNC_REVISION_1, 0, start)
        self._skip(start)
        return len(self._buffer) >= HEADER_BYTES

    def _skip(self, count: int) -> None:
        self._skipped += count
        del self._buffer[:count]
