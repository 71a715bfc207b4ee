"""What an entry of the journal does to the progress: the same for one that was just kept and for one from a file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Mapping

from ..errors import InvalidIdentity
from ..identity.identity import Identity
from ..identity.identity_document import identity_from
from .document import read_record, shown_text
from .frame_history import frame_from
from .frame_record import CheckEntry
from .journal import (
    CAR,
    CHECK,
    FURTHER,
    IDENTITY,
    LINE,
    LINE_BEGUN,
    POINT,
    REVISED,
    SESSION,
    SKIPPED,
    SUPERSEDED,
    Journal,
    KeptPoint,
)
from .line_result import LineResult, LineStatus, result_from_document
from .progress import Progress, car_from


class Notebook(Journal):
    """Journal that also grows the progress, also by an entry that could not be kept: in memory it is not lost."""

    def __init__(self, progress: Progress, result_type: type[LineResult], journal: Journal):
        self._progress = progress
        self._result_type = result_type
        self._journal = journal

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        try:
            self._journal.add(kind, values)
        finally:
            apply(self._progress, self._result_type, kind, values)

    def wait(self, patience_s: float = math.inf) -> bool:
        return self._journal.wait(patience_s)

    def check(self) -> None:
        self._journal.check()


def apply(progress: Progress, result_type: type[LineResult], kind: str, values: Mapping[str, Any]) -> None:
    """Grow the progress by an entry; KeyError, TypeError or ValueError when the entry is damaged."""
    if kind in (SESSION, IDENTITY):
        _apply_words(progress, kind, values)
    elif kind == CAR:
        progress.car = car_from(values)
    elif kind == CHECK:
        progress.frame_record.note_check(read_record(CheckEntry, values["check"]), frame_from(values["frame"]))
    elif kind in (LINE_BEGUN, FURTHER, SKIPPED):
        _apply_course(progress, kind, values)
    elif kind == SUPERSEDED:
        progress.points.clear()
    elif kind == POINT:
        progress.points[str(values["word"])] = KeptPoint(LineStatus(values["status"]), values["distance"],
                                                         values["frame"])
    elif kind == LINE:
        progress.record(result_from_document(result_type, values["result"]), frame_from(values["frame"]))
    elif kind == REVISED:
        progress.revise(result_from_document(result_type, values["result"]))


def _apply_course(progress: Progress, kind: str, values: Mapping[str, Any]) -> None:
    """Which line is measured, and which one is not."""
    if kind == LINE_BEGUN:
        progress.begin_line(int(values["line"]))
    elif kind == FURTHER:
        progress.measure_further()
    else:
        progress.skip(int(values["line"]))


def _apply_words(progress: Progress, kind: str, values: Mapping[str, Any]) -> None:
    """What a person said of the test, or was told."""
    if kind == SESSION:
        progress.session.update({shown_text(str(name)): shown_text(str(text)) for name, text in values.items()})
    else:
        progress.identity = _identity(values)


def _identity(values: Mapping[str, Any]) -> Identity:
    try:
        return identity_from(values)
    except InvalidIdentity as error:
        raise ValueError(str(error)) from None
