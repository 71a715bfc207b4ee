"""In which Car coordinate system each line was measured, and what the self-checks said, as plain values for files.

A corrected frame means that the Car stands elsewhere, or that the robot knows better where it stands; nobody can tell
which. A distance is relative to the Car as it was known when it was measured, so it stays in its frame and is never
transformed. Each frame and its correction are kept, so that a person can.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Iterator

from ..ports import CarCheck
from .frame_history import KnownFrame

_CM_PER_M = 100.0
_FRAME_KEYS = ("revision", "since_s", "correction_x_m", "correction_y_m", "correction_heading_rad")


@dataclass
class FrameRecord:
    """Grows with the test.

    Attributes:
        frames: one per frame; robot is the hexadecimal id of the run of the robot's software.
        lines: index in frames by number of the line, as a text.
        checks: one per self-check; None where the robot had no figure.
    """

    frames: list[dict[str, Any]] = field(default_factory=list)
    lines: dict[str, int] = field(default_factory=dict)
    checks: list[dict[str, Any]] = field(default_factory=list)

    def note_line(self, number: int, known: KnownFrame | None) -> None:
        """A line was measured in this frame."""
        if known is not None:
            self.lines[str(number)] = self._index_of(known)

    def note_check(self, check: CarCheck, known: KnownFrame | None, time_s: float) -> None:
        """A self-check has ended."""
        figures = {name: _known(getattr(check, name)) for name in ("difference_m", "difference_rad", "limit_m",
                                                                    "limit_rad")}
        self.checks.append({"robot_time_s": round(time_s, 3), "state": check.state.name.lower(), **figures,
                            "frame": None if known is None else self._index_of(known), "message": check.message})

    def sentences(self) -> Iterator[str]:
        """One line of text per frame and check."""
        for index, frame in enumerate(self.frames):
            lines = ", ".join(number for number, mine in self.lines.items() if mine == index)
            yield (f"Car frame {index + 1}: revision {frame['revision']} since {frame['since_s']:.1f} s of robot "
                   f"{frame['robot']}{_correction(frame)}; measured in it: {lines or 'nothing'}")
        for check in self.checks:
            yield f"self-check at {check['robot_time_s']:.1f} s: {check['state']}{_figures(check)}"

    def _index_of(self, known: KnownFrame) -> int:
        frame = known.frame
        entry = {"robot": f"{known.robot_session_id:x}", "revision": frame.revision,
                 "since_s": round(known.since_s, 3), "correction_x_m": round(frame.correction_x, 6),
                 "correction_y_m": round(frame.correction_y, 6),
                 "correction_heading_rad": round(frame.correction_heading, 6)}
        if entry not in self.frames:
            self.frames.append(entry)
        return self.frames.index(entry)


def record_from(document: Any) -> FrameRecord:
    """Record in a progress file, empty for a file that has none; raises TypeError or ValueError when it is damaged."""
    if document is None:
        return FrameRecord()
    record = FrameRecord([dict(frame) for frame in document["frames"]], dict(document["lines"]),
                         [dict(check) for check in document["checks"]])
    for frame in record.frames:
        if not isinstance(frame["robot"], str) or not all(_is_number(frame[key]) for key in _FRAME_KEYS):
            raise TypeError("frame")
    for check in record.checks:
        if not _is_number(check["robot_time_s"]) or not isinstance(check["state"], str):
            raise TypeError("check")
        if not all(check[key] is None or _is_number(check[key]) for key in ("difference_m", "difference_rad")):
            raise TypeError("check")
    if not all(isinstance(index, int) and 0 <= index < len(record.frames) for index in record.lines.values()):
        raise ValueError("frame of a line")
    return record


def _correction(frame: dict[str, Any]) -> str:
    x, y, heading = (frame[f"correction_{name}"] for name in ("x_m", "y_m", "heading_rad"))
    if not (x or y or heading):
        return ""
    return (f", corrected by {_CM_PER_M * x:.1f} cm ahead, {_CM_PER_M * y:.1f} cm to the left, "
            f"{math.degrees(heading):.2f} deg")


def _figures(check: dict[str, Any]) -> str:
    if check["difference_m"] is None:
        return ", the Car was not seen"
    limits = ""
    if check.get("limit_m") is not None and check.get("limit_rad") is not None:
        limits = f" (limits {_CM_PER_M * check['limit_m']:.1f} cm, {math.degrees(check['limit_rad']):.2f} deg)"
    return (f", difference {_CM_PER_M * check['difference_m']:.1f} cm, {math.degrees(check['difference_rad']):.2f} deg"
            f"{limits}")


def _known(value: float) -> float | None:
    return round(value, 6) if math.isfinite(value) else None


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
