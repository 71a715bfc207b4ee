"""Entry point: Ctrl-C is handled while the other modules are still being imported."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys

from mtr_operator.doctor.computer import Computer, computer_findings
from mtr_operator.station.checks.finding import State

from .exit_codes import EXIT_ERROR, EXIT_INTERRUPTED


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    try:
        from .commands import run_command
        return run_command(arguments)
    except KeyboardInterrupt:
        print("Interrupted.", file=sys.stderr)
        return EXIT_INTERRUPTED
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("mtr_operator"):
            raise
        return _say_missing(error.name)


def _say_missing(module: str) -> int:
    """Print the missing package; return the exit code."""
    print(f"The package {module} is not installed.", file=sys.stderr)
    for finding in computer_findings(Computer()):
        if finding.state is State.BAD:
            print(finding.sentence, file=sys.stderr)
    return EXIT_ERROR
