"""Does one copy of a test continue another? Then it has all that was measured in that one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Any, Mapping, Sequence

from sqlalchemy import Connection, select

from ..intake.trials import Row
from ..model.tests import Measurement, Trial

# What is measured of a distance, and what follows from neither the other lines nor the version of the program.
_OF_DISTANCE = ("line", "word", "status", "first_m", "second_m", "sigma_m")
# Of a point; under which line and attempt it is filed is no measurement.
_OF_POINT = ("word", "status", "distance_m", "sigma_m", "height_m", "speed_mps", "robot_time_s", "cause")
_OF_TRIAL = ("line", "number", "attempt", "x_m", "y_m", *_OF_POINT)


class Findings:
    """All that a copy of a test holds of what was measured, from rows of the tables.

    Attributes: trials: all of them, with where they are filed.
    """

    def __init__(self, measurements: Sequence[Mapping[str, Any]], trials: Sequence[Mapping[str, Any]]):
        self.trials = sorted(tuple(row[name] for name in _OF_TRIAL) for row in trials)
        self._distances = {tuple(row[name] for name in _OF_DISTANCE) for row in measurements}
        # Those of a journal alone have a time; what is read from a result is in the distances.
        self._points = collections.Counter(tuple(row[name] for name in _OF_POINT) for row in trials
                                           if row["robot_time_s"] is not None)

    def hold(self, other: Findings) -> bool:
        """True when nothing is missing of the other copy."""
        return other._distances <= self._distances and not other._points - self._points


def stored_findings(connection: Connection, number: int) -> Findings:
    """Of the test with this number in the store."""
    return Findings(*(_rows(connection, table, number) for table in (Measurement, Trial)))


def _rows(connection: Connection, table: type[Measurement] | type[Trial], number: int) -> list[Row]:
    found = connection.execute(select(table.__table__).where(table.test_id == number)).mappings()
    return [dict(row) for row in found]
