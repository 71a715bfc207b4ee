"""What is taken for a motion of the Car and what is not, and how sure its frame is afterwards."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from locator_simulation import Scene, World, car_with_bumpers

from mtr_car_locator.scan import RangeBias
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check

CAR = car_with_bumpers()
# A robot that goes on standing looks every 10 s; two looks have to agree.
LOOKED_AGAIN_S = 15.0


def mapped(**scene):
    """A world in which the Car has just been found."""
    world = World(Scene(CAR, **scene))
    assert world.run().state == CarState.LOCATED
    return world


@pytest.mark.parametrize("front_m, rear_m", [(0.02, 0.0), (0.0, 0.02), (0.02, 0.02), (-0.02, 0.02)])
def test_range_bias_is_no_motion_of_the_car(front_m, rear_m):
    world = mapped(range_bias=RangeBias(front_m, rear_m), pose_sigma_m=0.002)
    report = world.check(3).check
    assert report.state is Check.PASSED and report.difference_m < 0.005
    # Each LiDAR in turn looks at the Car's front alone.
    for heading in (math.pi, 0.0):
        world.pose = world.car @ Pose2(4.0, 0.3, heading)
        world.stand(0.5)
        assert world.stand(LOOKED_AGAIN_S).revision == 1
    assert world.error()[0] < 0.005
