"""Command line of campaigns."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
import os
import pathlib
import sys

from mtr_operator.cli.exit_codes import EXIT_ERROR, EXIT_FAIL, EXIT_INTERRUPTED, EXIT_PASS
from mtr_operator.domain.errors import OperatorError
from mtr_operator.terminal import show, show_error

_WORKSPACE = ("mtr_simulation", "mtr_core")
_SHOWN = 5


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return the exit code."""
    options = parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except OperatorError as error:
        show_error(error)
    except KeyboardInterrupt:
        print("Interrupted; what is done is kept, and the same command goes on.", file=sys.stderr)
        return EXIT_INTERRUPTED
    except ModuleNotFoundError as error:
        if error.name in _WORKSPACE:
            print(f"The robot's package {error.name} is not on the path: campaigns simulate with the robot's "
                  "workspace; source setup/env.bash.", file=sys.stderr)
        elif error.name is None or error.name.startswith("mtr_"):
            raise
        else:
            print(f'The package {error.name} is not installed; pip install "operator_gui/[campaign,results]" installs '
                  "all of them.", file=sys.stderr)
    return EXIT_ERROR


def parser() -> argparse.ArgumentParser:
    """Return the parser of mtr-campaign.

    Parsed arguments have a `run` function, which accepts them and returns the exit code.
    """
    made = argparse.ArgumentParser(prog="mtr-campaign", description="Simulated tests by the thousand, by a plan.")
    commands = made.add_subparsers(dest="command", required=True, metavar="COMMAND")
    command = commands.add_parser("run", parents=[_of_work()], help="what a plan asks for, as far as it is not done")
    command.add_argument("plan", type=pathlib.Path, metavar="PLAN.yaml")
    command.set_defaults(run=run_plan)
    command = commands.add_parser("check", help="say how many runs a plan asks for; runs none")
    command.add_argument("plan", type=pathlib.Path, metavar="PLAN.yaml")
    command.add_argument("--json", action="store_true", help="for a program")
    command.set_defaults(run=check)
    command = commands.add_parser("study", parents=[_of_work()], help="a study that ships, with its picture")
    command.add_argument("name", choices=["antennas", "sensors"],
                         help="antennas: placed for a wanted unlock area; sensors: which error matters most")
    command.add_argument("--short", action="store_true", help="fewer runs, for a look at it")
    command.set_defaults(run=run_study)
    return made


def _of_work() -> argparse.ArgumentParser:
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/campaigns"),
                        help="folder of the campaigns; each has one of its name; default %(default)s")
    common.add_argument("--workers", type=int, default=os.cpu_count() or 1,
                        help="processes of this computer, 0 for this one alone; default %(default)s")
    common.add_argument("--scheduler", default="", metavar="ADDRESS",
                        help="of Dask, tcp://HOST:8786; its workers have to see the same --out")
    common.add_argument("--store", default="", metavar="PATH|URL",
                        help="of the results; default results.sqlite in the campaign's folder, so that simulated tests "
                             "do not stand among measured ones")
    common.add_argument("--json", action="store_true", help="for a program")
    return common


def check(options: argparse.Namespace) -> int:
    """Validate a plan and print its number of runs."""
    from .kernels.registry import check_plan
    from .plan.plan import load_plan
    plan = load_plan(options.plan)
    check_plan(plan)
    if options.json:
        print(json.dumps({"campaign": plan.name, "runs": plan.size}))
    else:
        print(f"The plan {plan.name} asks for {plan.size} runs of {plan.scenario} by the kernel {plan.kernel}.")
    return EXIT_PASS


def run_plan(options: argparse.Namespace) -> int:
    """Run a plan; exit code 0 if every run has a result."""
    from .plan.plan import load_plan
    from .work.campaign import run_campaign
    finished = run_campaign(load_plan(options.plan), options)
    course = finished.course
    if options.json:
        print(json.dumps({"campaign": finished.plan.name, "folder": str(finished.folder), "store": finished.store,
                          "runs": len(course.runs), "known": course.known, "failed": len(course.failed)}))
    else:
        print(f"{len(course.runs)} runs, {course.known} of them done before, {len(course.failed)} failed; in "
              f"{finished.folder}, and in the store {finished.store} as campaign {finished.plan.name}.")
    for done in course.failed[:_SHOWN]:
        show_error(f"{done.digest}: {done.reason}")
    return EXIT_FAIL if course.failed else EXIT_PASS


def run_study(options: argparse.Namespace) -> int:
    """Run a study, and print the path of its picture."""
    from .studies.registry import study_of
    for line in study_of(options.name)(options):
        show(line)
    return EXIT_PASS
