"""Commands of the application and their error handling."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import sys
from typing import Callable

from mtr_operator.doctor.command_line import doctor
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.session_record import now
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.report.parameter_names import parameter_name
from mtr_operator.station.connection import RobotChoice
from mtr_operator.station.settings import Settings
from mtr_operator.storage.parameter_template import write_template
from mtr_operator.terminal import show_error

from .arguments import argument_parser
from .exit_codes import EXIT_ERROR, EXIT_FAIL, EXIT_INCONCLUSIVE, EXIT_INTERRUPTED, EXIT_NOT_READY, EXIT_PASS
from .history import compare_tests, list_history
from .orders.checking import check
from .orders.service import order_service
from .planning import plan
from .records.evidence import bundle_test, verify_bundles
from .records.replay import replay_test
from .run import CommandLineRun
from .window import open_window

_EXIT_CODES = {Verdict.NOT_SET: EXIT_PASS, Verdict.PASS: EXIT_PASS, Verdict.INCONCLUSIVE: EXIT_INCONCLUSIVE,
               Verdict.FAIL: EXIT_FAIL, Verdict.ABORTED: EXIT_ERROR, Verdict.ERROR: EXIT_ERROR}


def run_command(arguments: list[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    _accept_any_character()
    options = argument_parser().parse_args(arguments)
    try:
        return _COMMANDS.get(options.command, open_window)(options) or EXIT_PASS
    except OperatorError as error:
        show_error(error)
        return EXIT_ERROR
    except Cancelled as reason:
        show_error(reason)
        return EXIT_INTERRUPTED


def run_test(options: argparse.Namespace) -> int:
    """Run a test; return the exit code."""
    return _EXIT_CODES[CommandLineRun(options).run()]


def run_demo(options: argparse.Namespace) -> int:
    """Run a test without robot, Car and parameter file; return the exit code."""
    if options.out is None:
        moment = now().strftime("%Y-%m-%d_%H-%M-%S")
        options.out = Settings().result_folder / f"demo_{options.scenario}_{moment}"
    return run_test(options)


def pair(options: argparse.Namespace) -> None:
    """Pair with a robot; its modules are imported only on demand."""
    from mtr_operator.robot_link.access.command_line import pair_with
    pair_with(options)


def keys(options: argparse.Namespace) -> None:
    """Print or forget paired robots."""
    from mtr_operator.robot_link.access.command_line import show_keys
    show_keys(options)


def learn_car(options: argparse.Namespace) -> None:
    """Learn a Car's profile from its bus; the modules are imported only on demand."""
    from mtr_operator.car_link.learn.command_line import learn
    learn(options)


def try_car(options: argparse.Namespace) -> int:
    """Try profiles; the modules are imported only on demand."""
    from .cars.trying import try_profiles
    return try_profiles(options)


def examine(options: argparse.Namespace) -> int:
    """Check the computer, or a robot; return the exit code."""
    if options.robot is None:
        return EXIT_PASS if doctor() else EXIT_ERROR
    from mtr_operator.doctor.robot_command_line import look_at
    choice = RobotChoice(options.robot, options.subscriber_port, options.publisher_port, bool(options.unencrypted))
    return EXIT_PASS if look_at(choice) else EXIT_NOT_READY


def list_parameters(options: argparse.Namespace) -> None:
    """Print a table of a scenario's parameters, or write them to a file."""
    if options.write is not None:
        write_template(options.write, SCENARIOS[options.scenario])
        print(f"{options.write} has the parameters of {options.scenario} as they are proposed; edit it, then: "
              f"mtr-operator run {options.scenario} --params {options.write}")
        return
    rows = [("parameter", "default", "range", "meaning")]
    for name, declared in SCENARIOS[options.scenario].parameters_type.declarations().items():
        default = "-" if declared.default is None else declared.text(declared.default)
        meaning = f"{parameter_name(name, declared)}: {declared.doc}"
        rows.append((declared.file_key, default, declared.allowed, meaning))
    for name, chosen in SCENARIOS[options.scenario].parameters_type.choices().items():
        rows.append((name, chosen.default, chosen.allowed, chosen.doc))
    for name, declared in SCENARIOS[options.scenario].parameters_type.flags().items():
        rows.append((name, str(declared.default).lower(), declared.allowed, declared.doc))
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    for row in rows:
        print("  ".join([*(cell.ljust(width) for cell, width in zip(row, widths)), row[3]]))


def _accept_any_character() -> None:
    # A terminal without a degree sign must not end a test.
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


# Function of each command; it returns an exit code, or None after success.
_COMMANDS: dict[str, Callable[[argparse.Namespace], int | None]] = {
    "params": list_parameters, "check": check, "service": order_service,
    "history": list_history, "compare": compare_tests, "plan": plan,
    "demo": run_demo, "run": run_test, "pair": pair, "keys": keys, "learn": learn_car, "replay": replay_test,
    "bundle": bundle_test, "verify": verify_bundles,
    "try": try_car,
    "doctor": examine}
