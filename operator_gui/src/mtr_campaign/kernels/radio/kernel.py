"""Kernel `radio`: the application's scenarios on the radio model of the simulated Car, without robot dynamics."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib

from mtr_core.errors import RobotError
from mtr_core.parameters import parameters_from
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.progress import JournalMark
from mtr_operator.domain.results.session_record import now, session_record
from mtr_operator.storage.progress_file import FILE_NAME, save_progress

from ...errors import CampaignError
from ..order import Order
from ..outcome import Outcome, outcome_of
from .errors import RadioErrors
from .measuring import RadioTest, measure


class RadioKernel:
    """See Kernel."""

    name = "radio"

    def check(self, order: Order) -> None:
        """See Kernel."""
        _test_of(order)

    def run(self, order: Order, folder: pathlib.Path, digest: str) -> Outcome:
        """See Kernel."""
        measured = measure(_test_of(order))
        progress = measured.progress
        progress.session.update(session_record(now(), "simulated: radio", order.car.profile))
        progress.identity = Identity(car_model=f"simulated {order.car.name}")
        # The mark identifies the test in the store, so that repeated runs are the same test.
        progress.kept = JournalMark(f"campaign {digest}", len(progress.results))
        save_progress(folder / FILE_NAME, progress)
        return outcome_of(order, progress, measured.robot_s)


def _test_of(order: Order) -> RadioTest:
    if order.car.honest is None:
        raise CampaignError(f"The Car {order.car.name} has no radio that could be followed alone; the kernel radio "
                            "takes the honest Cars.")
    try:
        errors = parameters_from(order.errors, RadioErrors)
        return RadioTest(order.scenario, order.parameters, order.car.honest, errors, _facts(order.car.profile),
                         order.seed)
    except (RobotError, OperatorError) as error:
        raise CampaignError(str(error)) from None


@functools.lru_cache(maxsize=16)
def _facts(profile: str) -> LockFacts:
    return load_profile(profile).facts
