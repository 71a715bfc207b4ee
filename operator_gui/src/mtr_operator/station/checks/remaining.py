"""Rest of the current test: before a robot resumes, the same checks apply as before the start."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from typing import Sequence

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.robot_status import CarDimensions

from ..estimate import USUAL_CAR, Plan, plan_of
from ..sight.obstacle_map import ObstacleMap
from ..sight.ways import Ways, ways_of
from ..test import Test
from .checklist import Wanted


class Remaining:
    """Cached computation, which only updates changed parts: the checklist is evaluated with every Status."""

    def __init__(self) -> None:
        self._planned_for: tuple[object, ...] = ()
        self._looked_for: tuple[object, ...] = ()
        self._plan: Plan | None = None
        self._ways: Ways | None = None

    def of(self, test: Test, results: Sequence[LineResult], car: CarDimensions | None, facts: LockFacts,
           obstacles: ObstacleMap) -> Wanted:
        """Return the lines without a valid result, as a test that is about to start; car: None before it is mapped."""
        measured = {str(result.number) for result in results if not result.invalid_count}
        planned_for = (test.path, measured, car, facts)
        if planned_for != self._planned_for:
            self._planned_for, self._plan = planned_for, _rest(test, measured, car, facts)
        looked_for = (planned_for, obstacles.mark)
        if looked_for != self._looked_for:
            self._looked_for = looked_for
            self._ways = None if car is None or self._plan is None else ways_of(self._plan.stretches, car, obstacles)
        limits = test.progress.limits
        return Wanted(self._plan, 0 if limits is None else len(limits.requirements), ways=self._ways)


def _rest(test: Test, measured: set[str], car: CarDimensions | None, facts: LockFacts) -> Plan | None:
    """Return the plan of the rest; None if nothing is left, or the parameters do not match this Car, which the runner
    reports."""
    try:
        plan = plan_of(test.scenario, test.parameters, car or USUAL_CAR, car is not None, facts)
    except InvalidParameter:
        return None
    left = [(stretch, line_s) for stretch, line_s in zip(plan.stretches, plan.lines_s)
            if stretch.label not in measured]
    return dataclasses.replace(plan, stretches=tuple(stretch for stretch, _ in left),
                               lines_s=tuple(line_s for _, line_s in left)) if left else None
