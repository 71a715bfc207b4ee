"""The application without a window."""
# SPDX-License-Identifier: Apache-2.0
from .entry import main

__all__ = ["main"]
