"""The first thing that runs: Ctrl-C gets an answer while the rest is still being imported."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys

from .exit_codes import EXIT_INTERRUPTED


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; the exit code."""
    try:
        from .commands import run_command
        return run_command(arguments)
    except KeyboardInterrupt:
        print("Interrupted.", file=sys.stderr)
        return EXIT_INTERRUPTED
