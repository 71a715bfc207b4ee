"""Admission of a test on the current robot: a simulated one always, a real one under supervision."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..actions.control_loop import ControlLoop
from ..clocks.simulated_time import is_simulated_robot
from ..errors import RobotFailed
from ..identity.identity import Identity


def admit(loop: ControlLoop, identity: Identity | None) -> dict[str, str]:
    """Wait until the person has confirmed presence; return entries for the record of the test. RobotFailed or
    OperatorAbsent states why no test starts; the robot has not moved then."""
    if is_simulated_robot(loop.status):
        return {}
    supervision = loop.supervision
    missing = supervision.missing(identity)
    if missing:
        raise RobotFailed(missing)
    presence = supervision.presence
    while presence is not None and presence.is_asked and not supervision.is_unattended:
        loop.step()
    return supervision.record()
