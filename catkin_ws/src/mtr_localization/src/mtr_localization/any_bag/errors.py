"""Error of an unusable bag."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.errors import RobotError


class BagUnusable(RobotError):
    """The bag cannot be replayed; the sentence has the reason and a remedy."""
