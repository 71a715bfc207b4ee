"""Vector's binary logs (BLF), read with bounded memory whatever the file states; reports the position of damage."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import struct
import zlib
from typing import Generator, Iterator

import can
from can.io.blf import (
    CAN_MESSAGE,
    CAN_MESSAGE2,
    FILE_HEADER_SIZE,
    FILE_HEADER_STRUCT,
    LOG_CONTAINER,
    LOG_CONTAINER_STRUCT,
    NO_COMPRESSION,
    OBJ_HEADER_BASE_STRUCT,
    ZLIB_DEFLATE,
    BLFParseError,
    BLFReader,
)

from .text.lines import Damaged

# Containers have 128 kB by default, and 16 kB in the logs of this application.
MAX_CONTAINER_BYTES = 16 * 1024 ** 2
# The header has 144 bytes; later versions may extend it.
_MAX_HEADER_BYTES = 4096
# Each object begins with this signature, then length and version of its header, its total length and its kind.
_OBJECT, _LENGTH_AT, _HEADER = b"LOBJ", 8, OBJ_HEADER_BASE_STRUCT.size
_LENGTH_AND_KIND = struct.Struct("<LL")
# Vector's programs write restore points between the containers; they contain no frames.
_RESTORE_POINTS = 115
# Maximum bytes of padding and signature between two objects.
_PADDED = 8
# Classic frames with their whole header; a shorter object would contain bytes of the next one.
_MIN_BYTES = {CAN_MESSAGE: 48, CAN_MESSAGE2: 48}


class BlfLog(BLFReader):
    """Iterator over the messages; raises Damaged with the reason at the first damage.

    A container with a wrong check sum is discarded, because the position of the damage in it is unknown.
    """

    def __init__(self, path: pathlib.Path):
        _check_header(path)
        super().__init__(str(path))
        self._size = path.stat().st_size
        self._ends_early = False
        self._rest = bytearray()
        self._wanted = self._object_at = 0

    @property
    def is_cut_off(self) -> bool:
        """True if the file is shorter than its header states, or its program was killed before it wrote the length."""
        return (self._ends_early or self._is_incomplete or self._size < self.file_size
                or self.file_size == FILE_HEADER_SIZE < self._size)

    def __iter__(self) -> Generator[can.Message, None, None]:
        place = self.file.tell()
        while head := self.file.read(_HEADER):
            if len(head) < _HEADER:
                self._ends_early = True
                break
            yield from self._object(place, head)
            place = self.file.tell()
        self.stop()
        if self._is_incomplete and self._size == self.file_size:
            raise Damaged(f"an object that begins in the container at byte {self._object_at} is incomplete")

    @property
    def _is_incomplete(self) -> bool:
        return len(self._rest) > _PADDED

    def _object(self, place: int, head: bytes) -> Iterator[can.Message]:
        signature, _, _, length, kind = OBJ_HEADER_BASE_STRUCT.unpack(head)
        if signature != _OBJECT or length < _HEADER:
            raise Damaged(f"no object begins at byte {place}")
        if place + length > self._size == self.file_size:
            raise Damaged(f"the object at byte {place} states {length} bytes, more than the file has")
        if kind == _RESTORE_POINTS:
            self.file.seek(length - _HEADER + length % 4, 1)
            return
        if kind != LOG_CONTAINER:
            raise Damaged(f"the object at byte {place} is of kind {kind}, and only containers (10) can be there")
        if length > MAX_CONTAINER_BYTES:
            raise Damaged(f"the container at byte {place} states {length} bytes, {_AT_MOST}")
        yield from self._container(place, self.file.read(length - _HEADER), length - _HEADER)
        self.file.seek(length % 4, 1)

    def _container(self, place: int, body: bytes, length: int) -> Iterator[can.Message]:
        self._ends_early = len(body) < length
        if len(body) < LOG_CONTAINER_STRUCT.size:
            if self._ends_early:
                return
            raise Damaged(f"the container at byte {place} is shorter than its header")
        method, stated = LOG_CONTAINER_STRUCT.unpack_from(body)
        data = body[LOG_CONTAINER_STRUCT.size:]
        if method == ZLIB_DEFLATE:
            data = _inflated(place, data, stated, self._ends_early)
        elif method != NO_COMPRESSION:
            raise Damaged(f"the container at byte {place} has the unknown compression method {method}")
        yield from self._messages(place, data)

    def _messages(self, place: int, data: bytes) -> Iterator[can.Message]:
        self._rest += data
        if len(self._rest) < self._wanted:
            return
        end, fault = self._whole_objects()
        whole = bytes(self._rest[:end])
        del self._rest[:end]
        self._object_at = place if end else self._object_at or place
        try:
            yield from self._parse_data(whole)
        except (struct.error, BLFParseError):
            fault = "an object is shorter than its kind"
        if fault:
            raise Damaged(f"in the container at byte {place}, {fault}")

    def _whole_objects(self) -> tuple[int, str]:
        """Return the end of the last complete object, and the fault of the next one."""
        rest, end = self._rest, 0
        self._wanted = 0
        while end + _HEADER <= len(rest):
            begin = rest.find(_OBJECT, end, end + _PADDED)
            if begin < 0:
                return end, "no object begins behind the last one"
            if begin + _HEADER > len(rest):
                break
            length, kind = _LENGTH_AND_KIND.unpack_from(rest, begin + _LENGTH_AT)
            if not _MIN_BYTES.get(kind, _HEADER) <= length <= MAX_CONTAINER_BYTES:
                return end, f"an object states a length of {length} bytes"
            if begin + length > len(rest):
                self._wanted = begin + length - end
                break
            end = begin + length
        return end, ""


_AT_MOST = f"and at most {MAX_CONTAINER_BYTES // 1024 ** 2} MiB are read"


def _check_header(path: pathlib.Path) -> None:
    """Check the length of the header, because the library allocates this number of bytes."""
    with path.open("rb") as file:
        begin = file.read(FILE_HEADER_STRUCT.size)
    if len(begin) < FILE_HEADER_STRUCT.size:
        raise Damaged("its header is cut off")
    length = FILE_HEADER_STRUCT.unpack(begin)[1]
    if not FILE_HEADER_STRUCT.size <= length <= _MAX_HEADER_BYTES:
        raise Damaged(f"its header states a length of {length} bytes, and has {FILE_HEADER_SIZE}")


def _inflated(place: int, packed: bytes, stated: int, is_cut_off: bool) -> bytes:
    if stated > MAX_CONTAINER_BYTES:
        raise Damaged(f"the container at byte {place} states {stated} inflated bytes, {_AT_MOST}")
    unpacker = zlib.decompressobj()
    try:
        data = unpacker.decompress(packed, stated + 1)
    except zlib.error:
        raise Damaged(f"the compressed data of the container at byte {place} is corrupt") from None
    if len(data) > stated:
        raise Damaged(f"the container at byte {place} inflates to more than the {stated} bytes that it states")
    if not (unpacker.eof or is_cut_off):
        raise Damaged(f"the compressed data of the container at byte {place} is incomplete")
    return data
