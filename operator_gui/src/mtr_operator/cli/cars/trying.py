"""Command that tries a profile: an Autolock test with a simulated Car that sends the profile's frames."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import math
import pathlib
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.ports import CarEvent
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.terminal import show_error

from ..exit_codes import EXIT_CHANGED, EXIT_ERROR, EXIT_PASS

_SCENARIO = "autolock"
_PARAMETERS = {"passes": 1, "measurements_distance_m": 5.0, "self_check": False, "maximum_distance_m": 3.5}
_MS_PER_S = 1000.0


@dataclass(frozen=True)
class Tried:
    """Result of a trial. sent: changes on the bus, heard: changes that were understood. worst_s: largest difference of
    their times. contradictions: states that the CAN database describes differently."""

    results: Sequence[LineResult]
    sent: int
    heard: int
    worst_s: float
    cycle_s: float
    contradictions: Sequence[str] = ()

    @property
    def invalid(self) -> Sequence[LineResult]:
        """Invalid lines."""
        return [result for result in self.results if result.invalid_count]

    @property
    def is_good(self) -> bool:
        """True if every change was understood within a cycle of its message, and every line was measured."""
        return bool(self.results) and not self.invalid and self.heard == self.sent and self.worst_s <= self.cycle_s


def try_profiles(options: argparse.Namespace) -> int:
    """Try each profile; return the exit code."""
    code = EXIT_PASS
    for profile in options.profiles:
        try:
            tried = try_profile(profile, options.databases, options.seed, options.car_seed)
        except OperatorError as error:
            show_error(f"{profile}: {error}")
            code = EXIT_ERROR
            continue
        for sentence in tried.contradictions:
            show_error(f"{profile}: {sentence}")
        for result in tried.invalid:
            show_error(f"{profile}: {result.place} is invalid: {result.reason}")
        print(f"{profile}: {tried.heard} of {tried.sent} changes understood, {_MS_PER_S * tried.worst_s:.1f} ms off at "
              f"most, cycle {_MS_PER_S * tried.cycle_s:g} ms; {len(tried.results) - len(tried.invalid)} of "
              f"{len(tried.results)} axes measured")
        code = code if tried.is_good else max(code, EXIT_CHANGED)
    return code


def try_profile(profile: str, databases: pathlib.Path | None = None, seed: int = 1, car_seed: int = 1) -> Tried:
    """Run an Autolock test; OperatorError if the profile is faulty."""
    # The simulated Car is imported only on demand.
    from mtr_operator.car_link.further.state_texts import contradictions
    from mtr_operator.car_link.profile import load_profile
    from mtr_operator.car_link.spoken_car import SpokenCar
    from mtr_operator.robot_link.fake import FakeRobotLink
    scenario = SCENARIOS[_SCENARIO]
    kind = scenario.parameters_type
    parameters = kind.from_mapping({**kind.proposed(), **_PARAMETERS})
    progress = Progress(_SCENARIO, parameters.to_mapping())
    spoken = SpokenCar(FakeRobotLink(seed), f"try {profile}", seed, profile, databases, car_seed=car_seed)
    try:
        spoken.connect()
        spoken.car.connect()
        loop = ControlLoop(spoken, spoken.car)
        Runner(scenario, parameters, loop, progress, lambda _: None).run()
    finally:
        spoken.car.close()
        spoken.close()
    heard = [event for event in loop.events if not event.doubt]
    return Tried(progress.results, len(spoken.told), len(loop.events), _worst_s(spoken.told, heard),
                 spoken.cycle_s, tuple(contradictions(load_profile(profile, databases))))


def _worst_s(sent: Sequence[CarEvent], heard: Sequence[CarEvent]) -> float:
    differences = [abs(one.time_s - other.time_s) if one.lock_state is other.lock_state else math.inf
                   for one, other in zip(sent, heard)]
    return max(differences, default=math.inf)
