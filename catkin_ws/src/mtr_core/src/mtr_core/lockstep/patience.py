"""Wall time for which nodes wait for each other in lock-step; launch files may increase it, tests reduce it."""
# SPDX-License-Identifier: Apache-2.0
import rospy

from mtr_core.schedule import PRODUCER_LOST_AFTER_WALL_S

# The C++ nodes read the same parameter.
PATIENCE_PARAMETER = "/lockstep_patience_s"


def patience_s() -> float:
    """Return the wait for a producer's message, s."""
    return float(rospy.get_param(PATIENCE_PARAMETER, PRODUCER_LOST_AFTER_WALL_S))


def patience_at_least_s(usual_s: float) -> float:
    """Return the wait for a rare event, s; a reduced wait for producers does not shorten it."""
    return max(usual_s, patience_s())
