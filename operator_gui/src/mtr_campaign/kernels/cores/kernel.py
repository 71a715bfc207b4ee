"""Kernel `cores`: all node cores of the robot, the simulator and the application in one process, in lock-step."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

import yaml

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.results.session_record import now, session_record
from mtr_operator.storage.progress_file import FILE_NAME, save_progress

from ...errors import CampaignError
from ..order import Order
from ..outcome import Outcome, outcome_of
from .measuring import CoresTest, measure

CAR_FOLDER = "car"


class CoresKernel:
    """See Kernel."""

    name = "cores"

    def check(self, order: Order) -> None:
        """See Kernel."""
        if order.errors:
            raise CampaignError(f"The setting errors.{min(order.errors)} is of the kernel radio; in the kernel cores "
                                "errors come from the simulated sensors.")

    def run(self, order: Order, folder: pathlib.Path, digest: str) -> Outcome:
        """See Kernel."""
        # The simulator reads the Car from a file.
        car = folder / CAR_FOLDER / f"{order.car.name}.yaml"
        car.parent.mkdir()
        car.write_text(yaml.safe_dump(order.car_file), encoding="utf-8")
        progress = Progress(order.scenario.name, order.parameters.to_mapping(),
                            session_record(now(), "simulated: cores", order.car.profile))
        progress.identity = Identity(car_model=f"simulated {order.car.name}")

        def save(measured: Progress) -> None:
            # The mark identifies the test in the store, so that repeated runs are the same test.
            measured.kept = JournalMark(f"campaign {digest}", len(measured.results))
            save_progress(folder / FILE_NAME, measured)

        test = CoresTest(order.scenario, order.parameters, car, order.car.profile, order.seed, folder)
        robot_s = measure(test, progress, save)
        save(progress)
        return outcome_of(order, progress, robot_s)
