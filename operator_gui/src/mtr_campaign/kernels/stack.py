"""Kernel `stack`: the whole simulated robot in lock-step with the application, as a separate demo for each run.

The demo uses free ports for the ROS master and the robot link, and its own output folder. The number of parallel runs
is therefore limited only by the processors of the machine.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import sys

import yaml

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import FILE_NAME, open_progress

from ..errors import CampaignError
from .order import Order
from .outcome import Outcome, outcome_of

CAR_FOLDER, DEMO_FOLDER, LOG_FILE, PARAMETER_FILE = "car", "demo", "log.txt", "parameters.yaml"
# Limit of the wall time; the slowest scenario of the demo lasts some minutes.
_LIMIT_S = 3600.0


class StackKernel:
    """See Kernel."""

    name = "stack"

    def check(self, order: Order) -> None:
        """See Kernel."""
        if order.errors:
            raise CampaignError(f"The setting errors.{min(order.errors)} is of the kernel radio; in the kernel stack "
                                "errors come from the simulated sensors.")

    def run(self, order: Order, folder: pathlib.Path, digest: str) -> Outcome:
        """See Kernel."""
        name = order.scenario.name
        # The record of the test identifies the Car by its file.
        car = folder / CAR_FOLDER / f"{order.car.name}.yaml"
        car.parent.mkdir()
        car.write_text(yaml.safe_dump(order.car_file), encoding="utf-8")
        (folder / PARAMETER_FILE).write_text(yaml.safe_dump(order.parameters.to_mapping()), encoding="utf-8")
        status = self._demo(["--seed", str(order.seed), "--car", str(car), "--scenarios", name,
                             "--params", str(folder / PARAMETER_FILE), "--out", str(folder / DEMO_FOLDER)],
                            folder / LOG_FILE)
        path = folder / DEMO_FOLDER / name / FILE_NAME
        if status or not path.exists():
            raise CampaignError(f"The simulated robot's test ended with the status {status}; see {LOG_FILE} in the "
                                "run's folder.")
        progress = open_progress(path, SCENARIOS)[2]
        times = [getattr(result, field) for result in progress.results for field in vars(result)
                 if field.endswith("robot_time_s") and getattr(result, field) is not None]
        return outcome_of(order, progress, max(times, default=0.0))

    @staticmethod
    def _demo(arguments: list[str], log: pathlib.Path) -> int:
        with log.open("wb") as output:
            process = subprocess.Popen([sys.executable, "-m", "mtr_simulation.demo", *arguments], stdout=output,
                                       stderr=subprocess.STDOUT, start_new_session=True)
            try:
                return process.wait(_LIMIT_S)
            except BaseException as error:
                # On SIGINT, the demo shuts down its nodes.
                os.kill(process.pid, signal.SIGINT)
                process.wait()
                if isinstance(error, subprocess.TimeoutExpired):
                    raise CampaignError(f"The simulated robot's test took longer than {_LIMIT_S:g} s; see {log.name} "
                                        "in the run's folder.") from None
                raise
