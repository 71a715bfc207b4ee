"""Rows of the table: real-time requirements on the robot's nodes."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

from ..harness.rows import Requirement, Row
from .arrivals import VOICES, Silence, silences
from .measurement import Stretch
from .restarts import Restart


class Machine(enum.Enum):
    """Other load of the machine."""

    IDLE = "idle"
    BUSY = "busy"


# Allowed excess of a silence, as a share of the period; a longer silence delays the node's tick.
LATE_SHARE = 0.5
# On a busy machine other programs may use the processor for a while; after 0.5 s of silence the robot would be in
# FAULT.
BUSY_SILENCE_GOAL_S, BUSY_SILENCE_S = 0.25, 0.5


class Limits(NamedTuple):
    """Goal and limit; None: no limit."""

    goal: Optional[float]
    must: Optional[float]


NO_LIMITS = Limits(None, None)


def _of_both(name: str, unit: str, idle: Limits = NO_LIMITS, busy: Limits = NO_LIMITS) -> Dict[Machine, Requirement]:
    limits = {Machine.IDLE: idle, Machine.BUSY: busy}
    return {machine: Requirement(f"{name}, {machine.value}", unit, *limits[machine]) for machine in Machine}


SCAN_TO_TF = _of_both("end of a scan to map -> odom, 99 %", "s", Limits(0.02, 0.05), Limits(None, 0.25))
STOP = _of_both("the Operator's stop to the first slower command, worst", "s", Limits(0.03, 0.1), Limits(None, 0.4))
# For information: the robot plans its path before it starts, and the time through ZeroMQ depends on the machine.
COMMAND = _of_both("a waypoint sent to the first velocity at the wheels, worst", "s")
ECHO = _of_both("such a message through ZeroMQ alone and back, worst", "s")
ALARMS = _of_both("alarms of the nodes", "(count)", Limits(None, 0.0), Limits(None, 0.0))
CPU = _of_both("processor time of all the robot's nodes", "(share of a core)", Limits(0.25, 0.3), Limits(0.25, 0.3))
RESTARTS = Requirement("killed nodes after which the robot drove again", "(share)", must=1.0, at_least=True)


def judged(found: Mapping[Machine, Stretch], arrivals: Mapping[str, Sequence[float]],
           tf_ages: Sequence[Tuple[float, float]]) -> Tuple[List[Row], Dict[str, Any]]:
    """Return rows and figures of the intervals."""
    rows: List[Row] = []
    figures: Dict[str, Any] = {
        "silences": {}, "scan_to_tf_s": {}, "stop_s": {}, "command_s": {}, "echo_s": {}, "cpu": {}}
    for machine, stretch in found.items():
        silent = silences(arrivals, stretch.begin_s, stretch.end_s)
        ages_s = [age_s for time_s, age_s in tf_ages if stretch.begin_s <= time_s <= stretch.end_s]
        rows += [*(silence_row(machine, node, silent[node]) for node in VOICES),
                 *_latency_rows(machine, stretch, ages_s),
                 Row(ALARMS[machine], float(len(stretch.alarms))),
                 Row(CPU[machine], sum(stretch.cpu.values()), details=dict(stretch.cpu))]
        figures["silences"][machine.value] = {name: each._asdict() for name, each in silent.items()}
        figures["scan_to_tf_s"][machine.value] = _distribution(ages_s)
        figures["stop_s"][machine.value] = _distribution([each.brakes_s for each in stretch.stops])
        figures["command_s"][machine.value] = _distribution(stretch.starts_s)
        figures["echo_s"][machine.value] = _distribution(stretch.echoes_s)
        figures["cpu"][machine.value] = stretch.cpu
    return rows, figures


def silence_row(machine: Machine, node: str, found: Silence) -> Row:
    """Return the row of one node; the silence of its input is not counted."""
    must_s = BUSY_SILENCE_S
    goal_s: Optional[float] = BUSY_SILENCE_GOAL_S
    if machine is Machine.IDLE:
        must_s, goal_s = found.due_s + LATE_SHARE * found.period_s, None
    return Row(Requirement(f"silence of {node}, longest, {machine.value}", "s", goal_s, must_s), found.longest_s,
               details=_details(found.median_s, found.p99_s, found.longest_s),
               remark=f"{1e3 * found.longest_s:.0f} ms; 50 % {1e3 * found.median_s:.1f}, 99 % {1e3 * found.p99_s:.1f}")


def _latency_rows(machine: Machine, stretch: Stretch, ages_s: Sequence[float]) -> List[Row]:
    zero_s = max(stop.zero_s for stop in stretch.stops)
    stops_s = [stop.brakes_s for stop in stretch.stops]
    return [_latency_row(SCAN_TO_TF[machine], ages_s, 0.99),
            _latency_row(STOP[machine], stops_s, 1.0, f"{len(stops_s)} stops, zero after {zero_s:.2f} s"),
            _latency_row(COMMAND[machine], stretch.starts_s, 1.0, f"{len(stretch.starts_s)} waypoints"),
            _latency_row(ECHO[machine], stretch.echoes_s, 1.0)]


def _latency_row(wanted: Requirement, values_s: Sequence[float], part: float, remark: str = "") -> Row:
    median_s, p99_s, max_s = (_quantile(values_s, each) for each in (0.5, 0.99, 1.0))
    told = f"50 % {1e3 * median_s:.1f}, 99 % {1e3 * p99_s:.1f}, longest {1e3 * max_s:.1f} ms"
    return Row(wanted, _quantile(values_s, part), details=_details(median_s, p99_s, max_s),
               remark=", ".join(filter(None, (remark, told))))


def _details(median_s: float, p99_s: float, max_s: float) -> Dict[str, Optional[float]]:
    """Convert to JSON values: an infinite time is null."""
    return {name: value if math.isfinite(value) else None
            for name, value in (("p50_s", median_s), ("p99_s", p99_s), ("max_s", max_s))}


def restart_row(made: Sequence[Restart]) -> Row:
    """Return the row of all killed nodes."""
    recovered_s = [each.recovered_s for each in made if each.recovered_s is not None]
    return Row(RESTARTS, len(recovered_s) / len(made),
               remark=f"{len(made)} killed; at the latest after {max(recovered_s, default=0.0):.1f} s")


def _distribution(values: Sequence[float]) -> Dict[str, float]:
    return {"median": _quantile(values, 0.5), "p99": _quantile(values, 0.99), "max": max(values)}


def _quantile(values: Sequence[float], part: float) -> float:
    """Return one of the values, so that the result may be infinite."""
    return sorted(values)[math.ceil(part * len(values)) - 1]
