"""The Sleep time scenario: for how long a key that is held still answers."""
# SPDX-License-Identifier: Apache-2.0
from .sleep_time import SCENARIO

__all__ = ["SCENARIO"]
