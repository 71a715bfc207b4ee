"""MF4 logs: compressed blocks are checked, then asammdf reads the log in a separate process, which may crash."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import importlib.util
import mmap
import pathlib
import struct
import subprocess
import sys
import zlib
from typing import Iterator

import can

from . import mf4_frames
from .text.lines import Damaged

READER = pathlib.Path(mf4_frames.__file__)

# The standard limits a block to 4 MB.
MAX_BLOCK_BYTES = 16 * 1024 ** 2
_BLOCK = b"##DZ"
# Signature, length, number of links, kind of the original block, compression, its parameter, original and own size.
_HEADER = struct.Struct("<4s4xQQ2sBxLQQ")


class Mf4Log:
    """Iterator over the messages; raises Damaged if asammdf fails. NotImplementedError without that package."""

    def __init__(self, path: pathlib.Path):
        check_blocks(path)
        if importlib.util.find_spec("asammdf") is None:
            raise NotImplementedError
        self._path = path

    def __iter__(self) -> Iterator[can.Message]:
        size = mf4_frames.RECORD.size
        with subprocess.Popen([sys.executable, str(READER), str(self._path)], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as reader:
            try:
                assert reader.stdout is not None
                while len(record := reader.stdout.read(size)) == size:
                    yield mf4_frames.message(record)
                code = reader.wait()
            finally:
                reader.kill()
        if code:
            raise Damaged("asammdf reports damage" if code == mf4_frames.FAILED else "asammdf crashes")


def check_blocks(path: pathlib.Path) -> None:
    """Raise Damaged if a compressed block inflates to more than any program writes, whatever its header states."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as whole:
        for place in _places(whole):
            if _is_too_large(whole, place):
                raise Damaged(f"the compressed block at byte {place} inflates to more than "
                              f"{MAX_BLOCK_BYTES // 1024 ** 2} MiB")


def _places(whole: mmap.mmap) -> Iterator[int]:
    place = whole.find(_BLOCK)
    while place >= 0:
        yield place
        place = whole.find(_BLOCK, place + len(_BLOCK))


def _is_too_large(whole: mmap.mmap, place: int) -> bool:
    """Return True for an oversized block; False for data that resembles a signature, which does not inflate."""
    begin = place + _HEADER.size
    if begin > len(whole):
        return False
    size = _HEADER.unpack_from(whole, place)[-1]
    try:
        unpacker = zlib.decompressobj()
        return len(unpacker.decompress(whole[begin:begin + size], MAX_BLOCK_BYTES + 1)) > MAX_BLOCK_BYTES
    except zlib.error:
        return False
