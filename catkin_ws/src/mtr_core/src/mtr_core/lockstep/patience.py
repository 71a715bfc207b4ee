"""For how long of wall time nodes wait for each other in lock-step: who starts them may set more, and tests less."""
# SPDX-License-Identifier: Apache-2.0
import rospy

from mtr_core.schedule import PRODUCER_LOST_AFTER_WALL_S

# The C++ nodes read the same parameter.
PATIENCE_PARAMETER = "/lockstep_patience_s"


def patience_s() -> float:
    """For a producer's message."""
    return float(rospy.get_param(PATIENCE_PARAMETER, PRODUCER_LOST_AFTER_WALL_S))


def patience_at_least_s(usual_s: float) -> float:
    """For what is rare: less patience with silent producers is none of its own."""
    return max(usual_s, patience_s())
