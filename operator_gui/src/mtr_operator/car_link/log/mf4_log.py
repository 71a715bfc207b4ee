"""Compressed blocks of MF4 logs: checked before asammdf inflates them, which has no limit of its own."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import mmap
import pathlib
import struct
import zlib
from typing import Iterator

from .text.lines import Damaged

# The standard limits a block to 4 MB.
MAX_BLOCK_BYTES = 16 * 1024 ** 2
_BLOCK = b"##DZ"
# Signature, length, number of links, kind of the original block, compression, its parameter, original and own size.
_HEADER = struct.Struct("<4s4xQQ2sBxLQQ")


def check_blocks(path: pathlib.Path) -> None:
    """Raise Damaged when a compressed block inflates to more than any program writes, whatever its header states."""
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
    """Return False for a signature that is data, which does not inflate."""
    begin = place + _HEADER.size
    if begin > len(whole):
        return False
    size = _HEADER.unpack_from(whole, place)[-1]
    try:
        unpacker = zlib.decompressobj()
        return len(unpacker.decompress(whole[begin:begin + size], MAX_BLOCK_BYTES + 1)) > MAX_BLOCK_BYTES
    except zlib.error:
        return False
