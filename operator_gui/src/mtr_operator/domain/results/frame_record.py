"""In which Car coordinate system each line was measured, and what the self-checks said, as plain values for files.

A corrected frame means that the Car stands elsewhere, or that the robot knows better where it stands; nobody can tell
which. A distance is relative to the Car as it was known when it was measured, so it stays in its frame and is never
transformed. Each frame and its correction are kept, so that a person can.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, Iterator

from .. import limits
from ..limits import first_violation
from ..robot_status import CarCheck
from .document import OptionalFloat, OptionalInt, read_record, with_shown_texts
from .frame_history import KnownFrame

_CM_PER_M = 100.0
_MAX_DIGITS = 10


@dataclass(frozen=True)
class FrameEntry:
    """A frame, and where it lies in the one before. robot: hexadecimal id of the run of the robot's software."""

    robot: str
    revision: int
    since_s: float
    correction_x_m: float
    correction_y_m: float
    correction_heading_rad: float

    @property
    def correction(self) -> str:
        """The correction for a person; empty when there is none."""
        if not (self.correction_x_m or self.correction_y_m or self.correction_heading_rad):
            return ""
        return (f", corrected by {_CM_PER_M * self.correction_x_m:.1f} cm ahead, "
                f"{_CM_PER_M * self.correction_y_m:.1f} cm to the left, "
                f"{math.degrees(self.correction_heading_rad):.2f} deg")


@dataclass(frozen=True)
class CheckEntry:
    """A self-check; None where the robot had no figure. frame: index of the frame in which the robot was."""

    robot_time_s: float
    state: str
    difference_m: OptionalFloat
    difference_rad: OptionalFloat
    limit_m: OptionalFloat = None
    limit_rad: OptionalFloat = None
    frame: OptionalInt = None
    message: str = ""

    @property
    def figures(self) -> str:
        """Difference and limits for a person."""
        if self.difference_m is None or self.difference_rad is None:
            return ", the Car was not seen"
        limits = ""
        if self.limit_m is not None and self.limit_rad is not None:
            limits = f" (limits {_CM_PER_M * self.limit_m:.1f} cm, {math.degrees(self.limit_rad):.2f} deg)"
        return (f", difference {_CM_PER_M * self.difference_m:.1f} cm, {math.degrees(self.difference_rad):.2f} deg"
                f"{limits}")


@dataclass
class FrameRecord:
    """Grows with the test.

    Attributes:
        frames: one per frame.
        lines: index in frames by number of the line, as a text.
        checks: one per self-check.
    """

    frames: list[FrameEntry] = field(default_factory=list)
    lines: dict[str, int] = field(default_factory=dict)
    checks: list[CheckEntry] = field(default_factory=list)

    def note_line(self, number: int, known: KnownFrame | None) -> None:
        """A line was measured in this frame."""
        if known is not None:
            self.lines[str(number)] = self._index_of(known)

    def is_of(self, number: int, known: KnownFrame) -> bool:
        """True when a line was measured in this frame; of a line whose frame is not known nobody can say so."""
        index = self.lines.get(str(number))
        # When it began says when this run of the application saw it first.
        return index is not None and replace(self.frames[index], since_s=0.0) == replace(_entry_of(known), since_s=0.0)

    def note_check(self, entry: CheckEntry, known: KnownFrame | None) -> None:
        """A self-check has ended while the robot was in this frame."""
        self.checks.append(replace(entry, frame=None if known is None else self._index_of(known)))

    def sentences(self) -> Iterator[str]:
        """One line of text per frame and check."""
        for index, frame in enumerate(self.frames):
            lines = ", ".join(number for number, mine in self.lines.items() if mine == index)
            yield (f"Car frame {index + 1}: revision {frame.revision} since {frame.since_s:.1f} s of robot "
                   f"{frame.robot}{frame.correction}; measured in it: {lines or 'nothing'}")
        for check in self.checks:
            yield f"self-check at {check.robot_time_s:.1f} s: {check.state}{check.figures}"

    def _index_of(self, known: KnownFrame) -> int:
        entry = _entry_of(known)
        if entry not in self.frames:
            self.frames.append(entry)
        return self.frames.index(entry)


def _entry_of(known: KnownFrame) -> FrameEntry:
    frame = known.frame
    return FrameEntry(f"{known.robot_session_id:x}", frame.revision, round(known.since_s, 3),
                      round(frame.correction_x, 6), round(frame.correction_y, 6), round(frame.correction_heading, 6))


def record_from(document: Any) -> FrameRecord:
    """Record in a progress file, empty for a file that has none; KeyError, TypeError or ValueError: it is damaged."""
    if document is None:
        return FrameRecord()
    record = FrameRecord([read_record(FrameEntry, frame) for frame in document["frames"]], dict(document["lines"]),
                         [with_shown_texts(read_record(CheckEntry, check)) for check in document["checks"]])
    indices = [*record.lines.values(), *(check.frame for check in record.checks if check.frame is not None)]
    if not all(type(index) is int and 0 <= index < len(record.frames) for index in indices):
        raise ValueError("frame of a line")
    if not all(number.isdecimal() and limits.LINE_NUMBER.allows(int(number[:_MAX_DIGITS])) for number in record.lines):
        raise ValueError("number of a line")
    if first_violation([*(value for frame in record.frames for value in _limits_of_frame(frame)),
                        *(value for check in record.checks for value in _limits_of_check(check))]):
        raise ValueError("a number that cannot be true")
    return record


def _limits_of_frame(entry: FrameEntry) -> Iterator[tuple[limits.Limit, object]]:
    yield limits.STAMP, entry.since_s
    yield limits.CORRECTION, entry.correction_x_m
    yield limits.CORRECTION, entry.correction_y_m
    yield limits.HEADING, entry.correction_heading_rad


def _limits_of_check(entry: CheckEntry) -> Iterator[tuple[limits.Limit, object]]:
    yield limits.STAMP, entry.robot_time_s
    for value in (entry.difference_m, entry.difference_rad, entry.limit_m, entry.limit_rad):
        if value is not None:
            yield limits.CHECK_DIFFERENCE, value


def check_entry(check: CarCheck, time_s: float) -> CheckEntry:
    """What is recorded of a self-check that ended at an instant of robot time."""
    return CheckEntry(round(time_s, 3), check.state.name.lower(), _known(check.difference_m),
                      _known(check.difference_rad), _known(check.limit_m), _known(check.limit_rad),
                      message=check.message)


def _known(value: float) -> float | None:
    return round(value, 6) if math.isfinite(value) else None
