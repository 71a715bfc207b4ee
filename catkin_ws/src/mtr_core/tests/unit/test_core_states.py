"""Numbers of the messages on which pure code decides."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.states import CarState, Check, Direction, Result, State
from mtr_msgs.msg import CarCheck, CarEstimate, MotionStatus, RobotMode, Waypoint


@pytest.mark.parametrize("ours, message, prefix", [
    (State, RobotMode, ""), (CarState, CarEstimate, ""), (Result, MotionStatus, ""),
    (Direction, Waypoint, "DIRECTION_"), (Check, CarCheck, ""),
])
def test_numbers_are_those_of_the_message(ours, message, prefix):
    assert {prefix + item.name: item.value for item in ours} == {
        name: getattr(message, name) for name in vars(message) if name.isupper()}
