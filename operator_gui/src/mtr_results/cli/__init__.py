"""The command mtr-results."""
# SPDX-License-Identifier: Apache-2.0
from .entry import main

__all__ = ["main"]
