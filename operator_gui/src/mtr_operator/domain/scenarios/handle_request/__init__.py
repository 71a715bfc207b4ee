"""The Handle request scenario: from how far the Car unlocks when somebody takes its handle."""
# SPDX-License-Identifier: Apache-2.0
from .handle_request import SCENARIO

__all__ = ["SCENARIO"]
