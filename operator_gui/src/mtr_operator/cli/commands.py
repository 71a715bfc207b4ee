"""The commands: what each does, and how an error ends it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import sys

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.parameters import with_unit
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.trouble import Cancelled

from .arguments import argument_parser
from .measuring import run_test

EXIT_ERROR = 2
EXIT_INTERRUPTED = 130


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; the exit code."""
    options = argument_parser().parse_args(arguments)
    try:
        if options.command == "params":
            list_parameters(options)
        else:
            run_test(options)
    except OperatorError as error:
        print(error, file=sys.stderr)
        return EXIT_ERROR
    except (Cancelled, KeyboardInterrupt):
        print("Interrupted.", file=sys.stderr)
        return EXIT_INTERRUPTED
    return 0


def list_parameters(options: argparse.Namespace) -> None:
    """Print a table of a scenario's parameters."""
    rows = [("parameter", "default", "range", "meaning")]
    for declared in SCENARIOS[options.scenario].parameters_type.declarations().values():
        default = "-" if declared.default is None else with_unit(declared.default, declared.unit)
        rows.append((declared.file_key, default, declared.allowed, declared.doc))
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for row in rows:
        print("  ".join([*(cell.ljust(width) for cell, width in zip(row, widths)), row[3]]))
