"""Opens a textual log in any encoding, with or without gzip, and reads its lines in bounded memory."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import codecs
import gzip
import pathlib
import zlib
from typing import IO, Iterator, Mapping

from .lines import Damaged

# Maximum characters of a line.
_LONGEST = 4096
_GZIP = b"\x1f\x8b"
_MARKS = {codecs.BOM_UTF8: "utf-8-sig", codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}


def opened(path: pathlib.Path) -> IO[str]:
    """Return the text of a log; Damaged if its beginning cannot be decompressed."""
    with path.open("rb") as file:
        is_packed = file.read(len(_GZIP)) == _GZIP
    if not is_packed:
        with path.open("rb") as file:
            encoding = _encoding(file.read(4))
        return path.open(encoding=encoding, errors="replace")
    encoding = _encoding(_packed_begin(path, 4))
    return gzip.open(path, "rt", encoding=encoding, errors="replace")


def packed_kind(path: pathlib.Path, magic: Mapping[str, bytes]) -> str:
    """Return the suffix of a binary kind that is compressed with gzip; magic: first bytes of each kind."""
    with path.open("rb") as file:
        if file.read(len(_GZIP)) != _GZIP:
            return ""
    begin = _packed_begin(path, max(map(len, magic.values())))
    return next((suffix for suffix, each in magic.items() if begin.startswith(each)), "")


def _packed_begin(path: pathlib.Path, count: int) -> bytes:
    try:
        with gzip.open(path) as packed:
            return packed.read(count)
    except (EOFError, zlib.error, gzip.BadGzipFile):
        raise Damaged("its packed data is cut off or corrupt at its beginning") from None


def _encoding(begin: bytes) -> str:
    marked = next((name for mark, name in _MARKS.items() if begin.startswith(mark)), "")
    if marked:
        return marked
    # In UTF-16 without a byte order mark, a letter is next to a zero byte.
    return "utf-16-le" if begin[1:2] == b"\0" else "utf-16-be" if begin[:1] == b"\0" and len(begin) > 1 else "utf-8"


def whole_lines(file: IO[str]) -> Iterator[tuple[str, bool]]:
    """Yield each line, and True if it is complete; Damaged if compressed data ends too early."""
    try:
        while line := file.readline(_LONGEST):
            yield line, line.endswith("\n")
    except EOFError:
        raise Damaged("its packed data is cut off") from None
    except (zlib.error, gzip.BadGzipFile):
        # The check sum follows the data.
        raise Damaged("its packed data is corrupt there or before") from None
