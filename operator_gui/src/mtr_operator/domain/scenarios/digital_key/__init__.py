"""The Digital key scenario: how far off a phone's own distance is, at places around the Car."""
# SPDX-License-Identifier: Apache-2.0
from .digital_key import SCENARIO

__all__ = ["SCENARIO"]
