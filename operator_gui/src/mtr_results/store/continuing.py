"""Check whether one copy of a test continues another, that is, contains all its measurements."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Any, Mapping, Sequence

from sqlalchemy import Connection, select

from ..intake.trials import Row
from ..model.tests import Measurement, Trial

# Measured columns of a distance, independent of other lines and of the program version.
_OF_DISTANCE = ("line", "word", "status", "first_m", "second_m", "sigma_m")
# Measured columns of a point; its line and attempt are assignments, not measurements.
_OF_POINT = ("word", "status", "distance_m", "sigma_m", "height_m", "speed_mps", "robot_time_s", "cause")
_OF_TRIAL = ("line", "number", "attempt", "x_m", "y_m", *_OF_POINT)


class Findings:
    """All measurements of a copy of a test, from rows of the tables.

    Attributes: trials: all of them, with line, number and attempt.
    """

    def __init__(self, measurements: Sequence[Mapping[str, Any]], trials: Sequence[Mapping[str, Any]]):
        self.trials = sorted(tuple(row[name] for name in _OF_TRIAL) for row in trials)
        self._distances = {tuple(row[name] for name in _OF_DISTANCE) for row in measurements}
        # Only points of a journal have a time; points from a result are included in the distances.
        self._points = collections.Counter(tuple(row[name] for name in _OF_POINT) for row in trials
                                           if row["robot_time_s"] is not None)

    def hold(self, other: Findings) -> bool:
        """True if all measurements of the other copy are included."""
        return other._distances <= self._distances and not other._points - self._points


def stored_findings(connection: Connection, number: int) -> Findings:
    """Return the findings of the test with this number in the store."""
    return Findings(*(_rows(connection, table, number) for table in (Measurement, Trial)))


def _rows(connection: Connection, table: type[Measurement] | type[Trial], number: int) -> list[Row]:
    found = connection.execute(select(table.__table__).where(table.test_id == number)).mappings()
    return [dict(row) for row in found]
