"""The application without a window."""
# SPDX-License-Identifier: Apache-2.0
from .commands import main

__all__ = ["main"]
