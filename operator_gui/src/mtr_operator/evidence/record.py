"""Record of a test for programs, as JSON with a schema: results, car, people and equipment."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import importlib.metadata
import pathlib
import platform
from typing import Any

from mtr_operator import __version__
from mtr_operator.domain.results.line_result import LineResult, MeasuredDistance
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.assessment import Assessment

FORMAT, VERSION = "mtr test record", 1
SCHEMA = pathlib.Path(__file__).with_name("record.schema.json")
_PACKAGES = ("numpy", "scipy", "python-can", "cantools", "pyzmq", "protobuf", "uncertainties", "PyNaCl",
             "can-isotp", "udsoncan", "mcap", "duckdb")


def record_of(scenario: AnyScenario, progress: Progress, assessment: Assessment | None) -> dict[str, Any]:
    """Return plain values as in record.schema.json; distances in m, angles in the units of the columns."""
    judgement = None if assessment is None else assessment.judgement
    document = progress.to_document()
    return {
        "format": FORMAT, "version": VERSION, "scenario": scenario.name,
        "session": document["session"], "parameters": document["parameters"], "car": document["car"],
        "identity": document.get("identity"), "limits": document.get("limits"),
        "calibration": document.get("calibration"), "frame_record": document["frame_record"],
        "verdict": None if judgement is None else judgement.verdict.word,
        "planned_lines": _planned(scenario, progress),
        "lines": [_line(scenario, result) for result in progress.results],
        "columns": [{"name": column.name, "unit": column.unit, "meaning": column.doc}
                    for column in scenario.result_type.columns()],
        "software": versions()}


def versions() -> dict[str, str]:
    """Return the versions of the application, Python, the system and the packages that affect distances."""
    found = {"mtr-operator": __version__, "python": platform.python_version(), "system": platform.platform()}
    for name in _PACKAGES:
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


def _planned(scenario: AnyScenario, progress: Progress) -> list[dict[str, Any]]:
    """Return all lines of the test; none before the Car was mapped, because they depend on its size."""
    if progress.car is None:
        return []
    lines = scenario.lines(scenario.parameters_type.from_mapping(progress.parameters), progress.car)
    return [{"number": line.number, "kind": scenario.line_word} for line in lines]


def _line(scenario: AnyScenario, result: LineResult) -> dict[str, Any]:
    return {"number": result.number, "place": result.place, "kind": scenario.line_word, "reason": result.reason,
            "distances": [_distance(distance) for distance in result.distances], "values": result.to_document()}


def _distance(distance: MeasuredDistance) -> dict[str, Any]:
    return {"word": distance.word, "status": distance.status.value, "distance_m": distance.distance_m,
            "uncertainty_m": distance.uncertainty_m, "low_m": distance.low_m, "high_m": distance.high_m}
