"""The Relay resistance scenario: whether an extender has the Car unlock although its key is outside the zone."""
# SPDX-License-Identifier: Apache-2.0
from .relay_resistance import SCENARIO

__all__ = ["SCENARIO"]
