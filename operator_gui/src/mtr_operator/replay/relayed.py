"""Recomputes an axis of Relay resistance from its requests."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence

from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios.relay_resistance.axis_trial import tried_of
from mtr_operator.domain.scenarios.relay_resistance.result import valid_columns

from .points import Point

_UNPROVEN = "The Car did not unlock inside its zone, so that its silence beyond the border says nothing."


def relayed(points: Sequence[Point]) -> dict[str, Any]:
    """Return the columns: the extender's state is as recorded, the Car's reactions are from the bus. A proof that fails
    now is void, and so is a doubtful request."""
    newest = {point.word: point for point in points if point.new_distance is not None}
    tried = {point.word: each for point in newest.values() if point.new_distance is not None
             for each in tried_of({point.word: (point.new_status is LineStatus.OK, point.new_distance.distance_m)})}
    unlocked = [newest[word].new_distance for word, each in tried.items() if each.extender_on and each.unlocked]
    farthest = max(filter(None, unlocked), key=lambda place: place.distance_m, default=None)
    doubts = [point.doubt or _UNPROVEN for point in points
              if point.doubt or (point.word not in tried and point.new_status is not LineStatus.OK)]
    if not doubts:
        return valid_columns(list(tried.values()), farthest)
    return {**valid_columns(list(tried.values()), None), "status": LineStatus.INVALID, "resistance": "",
            "reason": doubts[0]}
