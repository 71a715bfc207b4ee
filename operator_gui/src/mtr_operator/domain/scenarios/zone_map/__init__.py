"""The Zone map scenario: where around the Car presses of the Remote key work, as a map with its uncertainty."""
# SPDX-License-Identifier: Apache-2.0
from .zone_map import SCENARIO

__all__ = ["SCENARIO"]
