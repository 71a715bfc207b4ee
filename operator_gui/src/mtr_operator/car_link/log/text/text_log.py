"""Frames of a textual log; its kind is detected by its content, and skipped lines are counted."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import pathlib
from typing import IO, Iterator, NamedTuple, Sequence, Tuple

from mtr_operator.domain.errors import ConnectionFailed

from .asc import Asc
from .candump import CandumpConsole, CandumpLog
from .lines import Ambiguous, Damaged, Line, LineReader, LoggedFrame, Names, WrongShape
from .opened import opened, whole_lines
from .others import Busmaster, Crtd, TimeIdData
from .tables import Table
from .trc import CanHackerTrace, PcanTrace

# Lines from which the kind of a log is detected.
_HEAD = 2000
_QUOTED = 80
_NOT_PRINTABLE = "\N{REPLACEMENT CHARACTER}"
_BY_SUFFIX = {".asc": "ASC", ".trc": "PCAN trace", ".csv": "table of SavvyCAN or python-can", ".log": "candump"}


Numbered = Tuple[int, str]


class _Trial(NamedTuple):
    """Result of one reader. score: frames first. place: of the reader. first: fault of the first unread line, of a
    reader that understands others. is_known: it understands some line. ambiguity: names of buses that cannot be
    numbered."""

    score: tuple[int, int, bool, bool, int]
    place: int
    first: str = ""
    is_known: bool = False
    ambiguity: str = ""


def _readers(names: Names) -> list[LineReader]:
    return [CandumpLog(), CandumpConsole(), Asc(names), PcanTrace(), CanHackerTrace(), Table(), Busmaster(), Crtd(),
            TimeIdData()]


def kinds() -> str:
    """Return the names of all kinds, for sentences."""
    return ", ".join(reader.name for reader in _readers({}))


class TextLog:
    """Iterator over the frames. ConnectionFailed or OSError if it is not a log; Damaged if it ends early.

    names: see Asc.

    Attributes:
        kind: of the log. left_out: lines that are not understood; first: fault of the first of them. without_data:
        remote and error frames.
    """

    def __init__(self, path: pathlib.Path, names: Names):
        self.left_out = self.without_data = 0
        self.first = ""
        self._path, self._names = path, names
        with opened(path) as file:
            self._head = list(_head(file))
        best = _best(self._head, names, path.suffix.lower())
        if best.ambiguity:
            buses = _printable(best.ambiguity[:_QUOTED])
            raise ConnectionFailed(f"The CAN log {path} names the buses {buses}, and only names with "
                                   "different numbers, such as can0 and can1, say which is which.")
        if not best.score[0]:
            raise ConnectionFailed(_refusal(path, self._head, best))
        self._place = best.place
        self.kind = self._reader().name

    def __iter__(self) -> Iterator[LoggedFrame]:
        reader, lengths = self._reader(), dict[tuple[int, bool, int], int]()
        with opened(self._path) as file:
            for number, (text, is_whole) in enumerate(whole_lines(file), 1):
                line = text.strip()
                try:
                    read = reader.read(line) if line else Line.NOTHING
                except ValueError as error:
                    self._leave_out(number, line, str(error))
                    continue
                except (Damaged, Ambiguous) as error:
                    raise Damaged(_quoted_line(number, line, str(error))) from None
                if isinstance(read, Line):
                    self.without_data += read is Line.NO_DATA
                    continue
                key = (read.can_id, read.is_extended, read.channel)
                if not is_whole and len(read.data) < lengths.get(key, 0):
                    self._leave_out(number, line, "is cut off")
                    continue
                lengths[key] = len(read.data)
                yield read

    def _reader(self) -> LineReader:
        reader = _readers(self._names)[self._place]
        reader.prepare([line for _, line in self._head])
        return reader

    def _leave_out(self, number: int, line: str, reason: str) -> None:
        self.left_out += 1
        self.first = self.first or _quoted_line(number, line, reason)


def _quoted_line(number: int, line: str, reason: str) -> str:
    return _printable(f'line {number} {reason}: "{line[:_QUOTED]}"')


def _printable(text: str) -> str:
    """Replace control characters, which would move the cursor of a terminal or end a string."""
    return "".join(each if each.isprintable() else " " if each.isspace() else _NOT_PRINTABLE for each in text)


def _best(head: Sequence[Numbered], names: Names, suffix: str) -> _Trial:
    """Return the trial of the reader that understands most of the first lines."""
    trials = [_tried(reader, at, head, suffix) for at, reader in enumerate(_readers(names))]
    return max(trials, key=lambda trial: trial.score)


def _tried(reader: LineReader, place: int, head: Sequence[Numbered], suffix: str) -> _Trial:
    reader.prepare([line for _, line in head])
    frames = known = others = 0
    first = strange = ""
    for number, line in head:
        try:
            is_frame = isinstance(reader.read(line), LoggedFrame)
        except WrongShape as error:
            strange = strange or _quoted_line(number, line, str(error))
        except (ValueError, Damaged) as error:
            known += 1
            first = first or _quoted_line(number, line, str(error))
        except Ambiguous as error:
            return _Trial((len(head), 0, True, True, -place), place, ambiguity=error.names)
        else:
            frames += is_frame
            others += not is_frame
    is_known = others > 0 or known > 0
    score = (frames, known, reader.is_recognized, _BY_SUFFIX.get(suffix) == reader.name, -place)
    return _Trial(score, place, first or (strange if is_known else ""), is_known)


def _refusal(path: pathlib.Path, head: Sequence[Numbered], best: _Trial) -> str:
    if best.first:
        return f"The CAN log {path} holds no frame that is understood: {best.first}."
    if best.is_known:
        return f"The CAN log {path} holds no frame."
    line = _quoted_line(*head[0], "is not understood") if head else "it is empty"
    return f"The CAN log {path} holds no frame: {line}; read are {kinds()}, BLF, MF4 and python-can's databases."


def _head(file: IO[str]) -> Iterator[Numbered]:
    """Yield the first lines that are not empty; of a damaged log the lines before the damage, but at least one."""
    count = 0
    try:
        for number, (text, _) in enumerate(itertools.islice(whole_lines(file), _HEAD), 1):
            if text.strip():
                count += 1
                yield number, text.strip()
    except Damaged:
        if not count:
            raise
