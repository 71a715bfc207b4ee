"""Check of the test area before a test: without one a real robot neither maps nor tests."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.geometry.area import area_m2
from mtr_operator.domain.robot_status import AreaState

from .finding import Check, Finding, Item, State


def test_area(state: AreaState | None) -> Item:
    """Return the state of the area: in force, missing, not needed by a simulated robot, or not reported by an older
    one."""
    if state is None:
        return Item(Check.TEST_AREA, State.UNKNOWN, Finding.AREA_UNTOLD)
    if state.problems or (state.required and not state.is_in_force):
        said = state.problems[0].text if state.problems else ""
        return Item(Check.TEST_AREA, State.BAD, Finding.AREA_MISSING, said)
    if not state.corners:
        return Item(Check.TEST_AREA, State.GOOD, Finding.AREA_NOT_NEEDED)
    finding = Finding.AREA_FIXED if state.is_fixed else Finding.AREA_KEPT
    return Item(Check.TEST_AREA, State.GOOD, finding, numbers=(area_m2(state.corners),))
