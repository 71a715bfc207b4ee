"""Error of the search for the Car: NotLocated, a ProblemError."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import ProblemError


class NotLocated(ProblemError):
    """The surfels do not show a trustworthy Car; the text has the reason."""
