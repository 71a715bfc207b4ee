"""Figures of the runs and their requirements, for a comparison of the simulators."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics
from typing import Any, Dict, List, Optional, Sequence, Tuple

from mtr_simulation.truth.compare import percentile
from mtr_simulation.truth.distance import Comparison

from ..harness.rows import Requirement, Row
from .noted import Notes, pose_errors
from .run import Run

# The same limit as in `make demo`: each distance is within 5 cm of the truth.
MAX_ERROR_M = 0.05
# Wall time: a simulation that runs slower is a different test.
MIN_REAL_TIME_FACTOR = 0.95


def judged(runs: Dict[str, Run]) -> Tuple[List[Row], Dict[str, Any]]:
    """Return the rows of the table, and all other figures for the file by simulator."""
    rows = [row for simulator, run in runs.items() for row in rows_of(simulator, run)]
    return rows, {simulator: figures_of(run) for simulator, run in runs.items()}


def rows_of(simulator: str, run: Run) -> List[Row]:
    """Return the rows of one simulator for comparison."""
    notes, positions = run.notes, sorted(error for error, _ in pose_errors(run.notes))
    rows = []
    for scenario, lines in run.lines.items():
        errors = sorted(abs(each.error_m) for each in good(lines))
        count = f"{simulator}: {scenario}, distances that are not ok, or without their true event"
        rows += [
            Row(Requirement(f"{simulator}: {scenario}, exit status", "(count)", must=0.0),
                float(run.statuses[scenario])),
            Row(Requirement(count, "(count)", must=0.0), float(len(lines) - len(errors)), bool(lines),
                {"of": float(len(lines))}, f"of {len(lines)}"),
            Row(Requirement(f"{simulator}: {scenario}, median error of a distance", "m"), _median(errors)),
            Row(Requirement(f"{simulator}: {scenario}, largest error of a distance", "m", must=MAX_ERROR_M),
                errors[-1] if errors else None)]
    return [*rows,
            Row(Requirement(f"{simulator}: median error of the position at the Car", "m"), _median(positions)),
            Row(Requirement(f"{simulator}: its 95th percentile", "m"),
                percentile(positions, 0.95) if positions else None),
            Row(Requirement(f"{simulator}: false stops", "(count)", must=0.0), float(notes.blockages)),
            Row(Requirement(f"{simulator}: things touched", "(count)", must=0.0), float(len(run.touched))),
            Row(Requirement(f"{simulator}: real-time factor", "(ratio)", must=MIN_REAL_TIME_FACTOR, at_least=True),
                notes.real_time_factor)]


def figures_of(run: Run) -> Dict[str, Any]:
    """Return all figures of one run; lengths in m, angles in rad."""
    return {
        "statuses": run.statuses, "touched": list(run.touched), "blockages": run.notes.blockages,
        "blocked": run.notes.blocked, "real_time_factor": run.notes.real_time_factor,
        "pose": _pose_figures(run.notes),
        "lines": {scenario: [line_figures(each) for each in lines] for scenario, lines in run.lines.items()}}


def good(lines: Sequence[Comparison]) -> List[Comparison]:
    """Return the distances that are ok and have a true event."""
    return [each for each in lines if each.measured.status == "ok" and math.isfinite(each.error_m)]


def line_figures(line: Comparison) -> Dict[str, Any]:
    """Return the figures of one distance."""
    measured = line.measured
    return {"line": measured.line, "event": measured.event, "side": measured.side, "status": measured.status,
            "distance_m": measured.distance_m, "true_distance_m": line.true_distance_m, "error_m": line.error_m,
            "uncertainty_m": measured.uncertainty_m}


def _pose_figures(notes: Notes) -> Dict[str, Optional[float]]:
    errors = pose_errors(notes)
    figures: Dict[str, Optional[float]] = {"count": float(len(errors))}
    for name, values in (("position_m", sorted(each for each, _ in errors)),
                         ("heading_rad", sorted(each for _, each in errors))):
        figures[f"{name}_median"] = _median(values)
        figures[f"{name}_95"] = percentile(values, 0.95) if values else None
        figures[f"{name}_max"] = values[-1] if values else None
    return figures


def _median(values: Sequence[float]) -> Optional[float]:
    return statistics.median(values) if values else None
