"""Figures by method, and the rows of the table."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ..harness.report import BenchmarkReport
from ..harness.rows import Requirement, Row
from .campaigns import AT_LIMIT, FADINGS, OVER_GROUND, POLLINGS, WIDTHS_M, Found
from .phones import Coverage
from .repeated import pairs_agree
from .result import LineFound, false_passes, figures, share, without_interval
from .verdicts import FAIL_BY_HOLE, Judged

# A share that should be 95 % has two rows: too few intervals contain the truth, or they are wider than necessary.
LEAST = Requirement("least", "(share)", 0.94, 0.92, at_least=True)
MOST = Requirement("most", "(share)", 0.96, 0.98)
LEAST_AGAIN = Requirement("least", "(share)", 0.94, 0.93, at_least=True)
BIAS = Requirement("bias of d50, width up to 2.2 m, worst", "m", 0.02, 0.05)
RATIO = Requirement("rms of d50 by the scan's, equal time, worst", "(ratio)", 1.0 / 3.0, 0.5)
PRESSES = Requirement("presses for +-0.3 m, width 1 m", "(count)", 10.0, 16.0)
STATIC = Requirement("static boundary, poll 300 ms, cycle 200 ms, rms", "m", 0.015, 0.03)
# A method that gives no interval in difficult cases would only be evaluated on easy ones.
WITHOUT = Requirement("lines without an interval", "(count)", must=0.0)
JUDGED = ("adaptive", "adaptive_scan_time", "passes")
LEAST_WHOLE = Requirement("least", "(share)", 0.94, 0.93, at_least=True)
WRONG_PASS = Requirement("whole tests at the limit, wrong pass, worst", "(share)", 0.025, 0.05)
WRONG_FAIL = Requirement("whole tests at the limit, wrong fail, worst", "(share)", 0.025, 0.05)
FALSE_PASS = Requirement("false pass, worst of Cars and limits", "(share)", 0.025, 0.05)


def report(found: Found, phones: Optional[Dict[str, Coverage]] = None) -> BenchmarkReport:
    """Return the report on all campaigns, and on the phones if they were measured."""
    pooled = {key: [line for campaign in campaigns for line in campaign] for key, campaigns in found.items()}
    details: Dict[str, Any] = {}
    for (method, *kind), lines in pooled.items():
        details.setdefault(method, {})["/".join(kind)] = (
            limit_figures(lines) if method == AT_LIMIT else figures(lines))
    phones = phones or {}
    details["phones"] = {name: each._asdict() for name, each in phones.items()}
    return BenchmarkReport([*rows(found, pooled, details), *whole_tests(details), *phone_rows(phones)],
                           {"details": details})


def limit_figures(lines: List[Judged]) -> Dict[str, Optional[float]]:
    """Return the figures of whole tests at the limit; the names are a stable interface. A line without an interval
    counts as not covered."""
    return {"lines": float(len(lines)), "pass": share([line.verdict == "pass" for line in lines]),
            "fail": share([line.verdict == "fail" for line in lines]),
            "fail_by_hole": share([line.verdict == FAIL_BY_HOLE for line in lines]),
            "coverage_95": share([bool(line.holds) for line in lines]),
            "judged_coverage": share([bool(line.judged_holds) for line in lines]),
            "half_width_median_m": float(np.nanmedian([line.half_m for line in lines])),
            "attempts_median": float(np.median([line.presses for line in lines])),
            "looks_mean": float(np.mean([line.looks for line in lines]))}


def whole_tests(details: Dict[str, Any]) -> List[Row]:
    """Return the rows of whole tests at the limit and over reflecting ground, as far as they were measured."""
    made: List[Row] = []
    limits = details.get(AT_LIMIT, {})
    if limits:
        for requirement, name in ((WRONG_PASS, "pass"), (WRONG_FAIL, "fail")):
            shares = _by_scenario(limits, name)
            worst = max(shares, key=lambda scenario: shares[scenario])
            made.append(Row(requirement, shares[worst], remark=worst,
                            details={kind: each[name] for kind, each in limits.items()}))
        made += _shares("coverage of whole tests at the limit", dict(_by_scenario(limits, "coverage_95")), LEAST_WHOLE)
    if OVER_GROUND in details:
        made += _shares("coverage over reflecting ground", {
            kind: each["coverage_95"] for kind, each in details[OVER_GROUND].items()}, LEAST_WHOLE)
    return made


def _by_scenario(limits: Dict[str, Any], name: str) -> Dict[str, float]:
    """Return a share over all kinds of Cars and tests together, because one kind has too few lines for a row."""
    lines: Dict[str, float] = {}
    counted: Dict[str, float] = {}
    for kind, each in limits.items():
        scenario = kind.split("/")[0]
        lines[scenario] = lines.get(scenario, 0.0) + each["lines"]
        counted[scenario] = counted.get(scenario, 0.0) + each["lines"] * each[name]
    return {scenario: counted[scenario] / count for scenario, count in lines.items()}


def phone_rows(phones: Dict[str, Coverage]) -> List[Row]:
    """Return the coverage of the phone's distance over the kinds that have valid places; a kind without one makes no
    claim."""
    shares = {name: each.share for name, each in phones.items() if each.share is not None}
    return _shares("coverage of a phone's distance", dict(shares)) if shares else []


def rows(found: Found, pooled: Dict[Tuple[str, ...], List[LineFound]], details: Dict[str, Any]) -> List[Row]:
    """Return the rows of the methods."""
    kinds = [f"{fading}/{width_m:g}" for fading in FADINGS for width_m in WIDTHS_M]
    adaptive, passes = details["adaptive"], details["passes"]
    again = {name: share(pairs_agree(found[(method, f"again_{name}")]))
             for name, method in (("key_press", "adaptive"), ("autolock", "passes"))}
    return [
        *_shares("coverage of d50", {kind: adaptive[kind]["coverage_95"] for kind in kinds}),
        *_shares("coverage of d95", {kind: adaptive[kind]["d95_coverage_95"] for kind in kinds}),
        *_shares("coverage of the static boundary", {kind: passes[kind]["coverage_95"] for kind in POLLINGS}),
        Row(BIAS, float(np.max([abs(adaptive[kind]["bias_m"]) for kind in kinds if float(kind.split("/")[1]) <= 2.2]))),
        _ratio(details, kinds),
        Row(PRESSES, adaptive["steady/1"]["presses_median"]),
        Row(STATIC, passes["poll_300_cycle_200"]["rms_m"]),
        *_shares("ten campaigns, pairs that agree", again, LEAST_AGAIN),
        _without(pooled),
        _false_pass(pooled),
    ]


def _shares(name: str, values: Dict[str, Optional[float]], least: Requirement = LEAST) -> List[Row]:
    """Return two rows: kinds with the smallest and the largest share; without a value if a share is unknown."""
    known = {kind: value for kind, value in values.items() if value is not None}
    rows_made = []
    for wanted, choose in ((least, min), (MOST, max)):
        kind = choose(known, key=lambda each: known[each]) if len(known) == len(values) else ""
        rows_made.append(Row(replace(wanted, name=f"{name}, {wanted.name}"), known.get(kind), details=values,
                             remark=kind))
    return rows_made


def _without(pooled: Dict[Tuple[str, ...], List[LineFound]]) -> Row:
    """Return the row of the application's methods."""
    counts = {"/".join(key): float(without_interval(lines)) for key, lines in pooled.items() if key[0] in JUDGED}
    return Row(WITHOUT, sum(counts.values()), details={kind: count for kind, count in counts.items() if count})


def _false_pass(pooled: Dict[Tuple[str, ...], List[LineFound]]) -> Row:
    """Return the worst share over all Cars of one method, because a limit applies to the tests of many Cars."""
    shares = {method: false_passes([line for key, lines in pooled.items() if key[0] == method for line in lines])
              for method in ("adaptive", "passes")}
    named = {f"{method}, {limit}": value for method, each in shares.items() for limit, value in each.items()}
    worst = list(named)[int(np.argmax(list(named.values())))]
    return Row(FALSE_PASS, named[worst], details=named, remark=worst)


def _ratio(details: Dict[str, Any], kinds: List[str]) -> Row:
    ratios = {kind: details["adaptive_scan_time"][kind]["rms_m"] / details["scan_beside"][kind]["rms_m"]
              for kind in kinds}
    values = list(ratios.values())
    return Row(RATIO, float(np.max(values)), details=ratios, remark=f"median {np.median(values):.2f}")
