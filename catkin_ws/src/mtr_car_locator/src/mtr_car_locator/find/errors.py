"""What the search for the Car raises: NotLocated, a ProblemError."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import ProblemError


class NotLocated(ProblemError):
    """The surfels do not show a Car that can be trusted; the text says what they show."""
