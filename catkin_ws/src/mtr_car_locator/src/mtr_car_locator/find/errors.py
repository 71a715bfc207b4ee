"""What the search for the Car raises: NotLocated, a RobotError."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.errors import RobotError


class NotLocated(RobotError):
    """The surfels do not show a Car that can be trusted; the text says what they show."""
