"""Optimisation with Optuna: settings for the best value of a figure."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from typing import Any, Sequence

from ..errors import CampaignError
from ..plan.factors import Uniform, Values
from ..plan.plan import Plan
from ..plan.run import Value
from .folder import OK, Done

_WANTED, _MAXIMISE = "wanted", "maximise"


class Optimiser:
    """Optimiser of one plan; deterministic for the same seed and results."""

    def __init__(self, plan: Plan):
        import optuna
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        self._plan = plan
        self._failed = optuna.trial.TrialState.FAIL
        self._study = optuna.create_study(
            direction="maximize" if plan.design.aim == _MAXIMISE else "minimize",
            sampler=optuna.samplers.TPESampler(seed=plan.design.seed, constant_liar=True))
        self._asked: list[Any] = []

    def ask(self, count: int) -> list[dict[str, Value]]:
        """Return the settings of the next runs."""
        self._asked = [self._study.ask() for _ in range(count)]
        return [{name: self._suggested(trial, name) for name in self._plan.factors} for trial in self._asked]

    def tell(self, runs: Sequence[Done]) -> None:
        """Report the results of the requested runs, in their order."""
        for trial, done in zip(self._asked, runs):
            value = None if done.status != OK else figure_of(self._plan, done)
            if value is None:
                self._study.tell(trial, state=self._failed)
            else:
                self._study.tell(trial, value)

    def _suggested(self, trial: Any, name: str) -> Value:
        factor = self._plan.factors[name]
        if isinstance(factor, Values):
            return trial.suggest_categorical(name, list(factor.values))  # type: ignore[no-any-return]
        if isinstance(factor, Uniform):
            return float(trial.suggest_float(name, factor.low, factor.high))
        return factor.at(float(trial.suggest_float(name, 0.0, 1.0)))


def figure_of(plan: Plan, done: Done) -> float | None:
    """Return the optimised figure of a run; None if the run does not have it.

    With the aim `wanted`, the figure is a distance, and the result is its root mean square deviation from the target
    over all lines. Raises CampaignError for an unknown figure.
    """
    design = plan.design
    if design.aim == _WANTED:
        distances = done.outcome["distances"].get(design.figure)
        if distances is None:
            raise CampaignError(f"{design.figure} is no distance of {plan.scenario}; there are "
                                f"{', '.join(done.outcome['distances'])}.")
        known = [value - design.wanted for value in distances.values() if value is not None]
        # A missing distance counts as a deviation by the whole target.
        missing = [design.wanted] * (len(distances) - len(known))
        return math.sqrt(statistics.fmean([each * each for each in (*known, *missing)])) if distances else None
    if design.figure not in done.outcome["figures"]:
        raise CampaignError(f"{design.figure} is no figure of the test; there are "
                            f"{', '.join(done.outcome['figures'])}.")
    return float(done.outcome["figures"][design.figure])
