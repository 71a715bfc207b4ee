"""Runs Autolock and Key press on the wall clock, in Gazebo and in MuJoCo; figures go to gazebo.json.

Usage: python -m mtr_benchmarks.gazebo --out out/bench

The exit status is 0 if every row meets its requirement, 1 if one does not, and 2 if a simulator did not start.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import Any, Dict, List, Optional

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.site.scenario_file import chosen_scenario
from mtr_simulation.stack import StackError

from ..harness.report import BenchmarkReport, finish
from .judge import judged
from .run import GAZEBO, MUJOCO, READERS, RunOptions, run


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--seed", type=int, default=1, help="seed of every random number but Gazebo's own")
    parser.add_argument("--site", default="lot", help="name or YAML file of a scenario of mtr_simulation")
    parser.add_argument("--car", default="gentle", help="radio and electronics of the Car")
    parser.add_argument("--simulators", nargs="*", choices=[GAZEBO, MUJOCO], default=[GAZEBO, MUJOCO])
    parser.add_argument("--scenarios", nargs="*", choices=list(READERS), default=list(READERS))
    parser.add_argument("--parameters", type=pathlib.Path, help="folder with a YAML file for each scenario")
    parser.add_argument("--server", default="", help="command that starts Gazebo's server; default: gzserver")
    options = parser.parse_args(arguments)
    try:
        chosen_scenario(options.site)
        chosen_car(options.car)
        runs = {each: run(each, _run_options(options, each)) for each in options.simulators}
    except (StackError, ConfigurationError) as error:
        print(error, file=sys.stderr)
        return 2
    rows, figures = judged(runs)
    head: Dict[str, Any] = {"seed": options.seed, "site": options.site, "car": options.car}
    remarks = [f"{name} touched {thing}" for name, each in runs.items() for thing in each.touched]
    remarks += [f"{name} stopped: {why}" for name, each in runs.items() for why in each.notes.blocked]
    return finish(BenchmarkReport(rows, {**head, **figures}, remarks), options.out / "gazebo.json")


def _run_options(options: argparse.Namespace, simulator: str) -> RunOptions:
    site = str(pathlib.Path(options.site).resolve()) if pathlib.Path(options.site).suffix else options.site
    car = str(pathlib.Path(options.car).resolve()) if options.car.endswith(".yaml") else options.car
    return RunOptions(options.out / "gazebo" / simulator, options.seed, site, car, tuple(options.scenarios),
                      options.parameters, options.server)


if __name__ == "__main__":
    sys.exit(main())
