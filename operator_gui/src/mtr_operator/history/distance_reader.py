"""Distances of one test: the measured value, and its interval with all errors."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import Figure, figure_of
from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance
from mtr_operator.domain.verdict.assessment import Assessment, Assessor, LastingSigmas
from mtr_operator.storage.given_files import calibration_of

from .line_pairs import Side

Ends = tuple[float, float]


class DistanceReader:
    """Distances of one test."""

    def __init__(self, side: Side):
        self._side = side
        progress = side.progress
        self._assessor = Assessor(side.scenario, side.parameters, progress.measured_car, calibration_of(progress))
        self._alive = {distance.word for result in progress.results for distance in result.distances
                       if distance.status is LineStatus.OK}

    def figure(self, result: LineResult, distance: MeasuredDistance) -> Figure:
        """Return the value or the known ends of a distance."""
        return figure_of(distance, part(self._side.scenario, Judging).unreached(
            self._side.parameters, result, distance.word))

    def ends(self, result: LineResult, distance: MeasuredDistance) -> Ends | None:
        """Return the 95 % interval; None if the method gives none."""
        return self._assessor.interval(result, distance) if self.is_alive(distance.word) else None

    def is_alive(self, word: str) -> bool:
        """Return False if the key worked on no line of the test: it may have been asleep."""
        return word in self._alive

    def assessment(self) -> Assessment:
        """Return budgets and verdicts of the test."""
        return self._assessor.assess(self._side.progress)

    def unshown_sigma_m(self, result: LineResult, word: str) -> float:
        """Return 1 sigma of the errors that repeating the test does not show, or not completely."""
        return self._assessor.guard_sigma(result, word)

    def lasting_sigmas(self, result: LineResult, word: str) -> LastingSigmas:
        """Return the errors of a distance that other lines or other tests have in common with it."""
        return self._assessor.lasting_sigmas(result, word)
