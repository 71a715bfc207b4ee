"""Distances as text, equal in window, files and command line: templates that a window translates, and digits.

All are in m, like the columns of results.csv and the parameters.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Callable, Sequence

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import Figure, Kind, between, figure_of, interval_of
from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance, has_intervals
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

# Templates for the cell of a table, whose heading has the unit.
TEMPLATES = {
    Kind.VALUE: "{first}", Kind.AT_LEAST: "at least {first}", Kind.AT_MOST: "at most {first}",
    Kind.BETWEEN: "{first} to {second}", Kind.NOT_REACHED: "not reached", Kind.INVALID: "invalid",
    Kind.UNKNOWN: "unknown"}
# Templates for a label next to a point, with little space.
SIGNS = {
    Kind.VALUE: "{first} m", Kind.AT_LEAST: "\N{GREATER-THAN OR EQUAL TO} {first} m",
    Kind.AT_MOST: "\N{LESS-THAN OR EQUAL TO} {first} m", Kind.BETWEEN: "{first}\N{EN DASH}{second} m",
    Kind.NOT_REACHED: "", Kind.INVALID: "", Kind.UNKNOWN: "?"}
_PLUS_MINUS = "\N{PLUS-MINUS SIGN}"
# Headings of the columns next to a distance.
KEY, INTERVAL = "key", "95 %"
OF_PLACE = ("Beside each distance stands 1 sigma of where the Remote key was at this one event; at another attempt the "
            "Car may react elsewhere, by more than that.")
OF_BOUNDARY = ("Beside each distance stands 1 sigma of the boundary, and its 95 % interval: in 95 of 100 tests like "
               "this one it holds where the Car decides either way equally often.")
OF_PLACES = ("Of a range between two places the nearer one is the farthest press that worked, the other the next one "
             "that failed; a range of at least a place worked at the first.")
OF_REPORTED = ("Beside each distance that the phone told stands 1 sigma of where it really was, and the 95 % interval "
               "of what it told there; the errors are in results.csv.")
# A reader who interprets a distance by its sigma needs a resolution finer than the sigma.
_FINE_M, _FINE_DIGITS, _DIGITS, _SIGMA_DIGITS = 0.05, 3, 2, 3
Number = Callable[[float, int], str]
Translation = Callable[[str], str]


def plain_number(value: float, digits: int) -> str:
    """Return the number with a decimal point."""
    return f"{value:.{digits}f}"


def figures_of(scenario: AnyScenario, parameters: ScenarioParameters | None, result: LineResult) -> list[Figure]:
    """Return the figure of each distance of a line; without parameters, a distance that was not reached has no
    bound."""
    return [figure_of(distance, (None, None) if parameters is None
                      else part(scenario, Judging).unreached(parameters, result, distance.word))
            for distance in result.distances]


def filled(template: str, figure: Figure, number: Number = plain_number, sigma_m: float | None = None) -> str:
    """Return a template, translated or not, with the figure's numbers. sigma_m: of a value."""
    is_fine = figure.kind is Kind.VALUE and sigma_m is not None and sigma_m < _FINE_M
    digits = _FINE_DIGITS if is_fine else _DIGITS
    ends = ("" if end is None else number(end, digits) for end in (figure.first_m, figure.second_m))
    return template.format(**dict(zip(("first", "second"), ends)))


def sigma_text(sigma_m: float | None, number: Number = plain_number) -> str:
    """Return the sigma, never as zero: a sigma below the resolution is shown as an upper bound."""
    if sigma_m is None:
        return ""
    least = 10.0 ** -_SIGMA_DIGITS
    return number(sigma_m, _SIGMA_DIGITS) if sigma_m >= least / 2.0 else f"< {number(least, _SIGMA_DIGITS)}"


def ends_text(low: float, high: float, number: Number = plain_number, translated: Translation = lambda text: text,
              digits: int = _DIGITS) -> str:
    """Return both ends of an interval, or the end that is finite; empty without any."""
    figure = between(*(end if math.isfinite(end) else None for end in (low, high)))
    ends = ("" if end is None else number(end, digits) for end in (figure.first_m, figure.second_m))
    return "" if figure.kind is Kind.NOT_REACHED else translated(TEMPLATES[figure.kind]).format(
        **dict(zip(("first", "second"), ends)))


def interval_text(distance: MeasuredDistance, number: Number = plain_number,
                  translated: Translation = lambda text: text) -> str:
    """Return the interval of a boundary; empty without one."""
    figure = interval_of(distance)
    return "" if figure is None else filled(translated(TEMPLATES[figure.kind]), figure, number)


def sigma_word(results: Sequence[LineResult], translated: Translation = lambda text: text) -> str:
    """Return the heading of the uncertainties; it names the key if they include only its position."""
    return _PLUS_MINUS if has_intervals(results) else f"{translated(KEY)} {_PLUS_MINUS}"


def meanings(results: Sequence[LineResult]) -> list[str]:
    """Return sentences on the meaning of a test's figures."""
    if not any(distance.status is LineStatus.OK for result in results for distance in result.distances):
        return []
    if any(distance.key_m is not None for result in results for distance in result.distances):
        return [OF_REPORTED]
    has_places = any(distance.is_place for result in results for distance in result.distances)
    return [OF_BOUNDARY if has_intervals(results) else OF_PLACE, *([OF_PLACES] if has_places else [])]
