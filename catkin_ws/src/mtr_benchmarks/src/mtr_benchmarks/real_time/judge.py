"""Rows of the table: what the robot's nodes are to be in real time."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import Any, Dict, List, Mapping, Sequence, Tuple

from ..harness.rows import Requirement, Row
from .arrivals import VOICES, silences, worst
from .measurement import Stretch
from .restarts import Restart


class Machine(enum.Enum):
    """What else the machine has to do."""

    IDLE = "idle"
    BUSY = "busy"


# A node that is silent for longer than its period and half of one more blocks its tick. On a busy machine the processor
# may be another's for a while; after 0.5 s of silence the robot would be in FAULT.
SILENCE = {Machine.IDLE: Requirement("longest silence of a node beyond its period, idle", "(share of a period)",
                                     must=0.5),
           Machine.BUSY: Requirement("longest silence of a node, busy", "s", goal=0.25, must=0.5)}
SCAN_TO_TF = {Machine.IDLE: Requirement("end of a scan to map -> odom, 99 %, idle", "s", goal=0.02, must=0.05),
              Machine.BUSY: Requirement("the same, busy", "s", must=0.25)}
STOP = {Machine.IDLE: Requirement("the Operator's stop to the first slower command, worst, idle", "s", goal=0.03,
                                  must=0.1),
        Machine.BUSY: Requirement("the same, busy", "s", must=0.4)}
ALARMS = {Machine.IDLE: Requirement("alarms of the nodes, idle", "(count)", must=0.0),
          Machine.BUSY: Requirement("the same, busy", "(count)", must=0.0)}
RESTARTS = Requirement("killed nodes after which the robot drove again", "(share)", must=1.0, at_least=True)
CPU = Requirement("processor time of all the robot's nodes, idle", "(share of a core)", goal=0.25, must=0.3)


def judged(found: Mapping[Machine, Stretch], arrivals: Mapping[str, Sequence[float]],
           tf_ages: Sequence[Tuple[float, float]]) -> Tuple[List[Row], Dict[str, Any]]:
    """Rows and figures of the stretches."""
    rows: List[Row] = []
    figures: Dict[str, Any] = {"silences": {}, "scan_to_tf_s": {}, "stop_s": {}, "echo_s": {}, "cpu": {}}
    for machine, stretch in found.items():
        silent = silences(arrivals, stretch.begin_s, stretch.end_s)
        node, longest = worst(silent)
        value = longest.late if machine is Machine.IDLE else max(silent[name].longest_s for name in VOICES)
        ages_s = [age_s for time_s, age_s in tf_ages if stretch.begin_s <= time_s <= stretch.end_s]
        zero_s = max(stop.zero_s for stop in stretch.stops)
        slowest = max(stretch.stops, key=lambda stop: stop.brakes_s)
        echo_s = _quantile(stretch.echoes_s, 0.5)
        rows += [Row(SILENCE[machine], value, remark=f"{node}, {longest.longest_s:.3f} s"),
                 Row(SCAN_TO_TF[machine], _quantile(ages_s, 0.99), remark=f"median {_quantile(ages_s, 0.5):.4f} s"),
                 Row(STOP[machine], slowest.brakes_s,
                     remark=f"{len(stretch.stops)} stops, zero after {zero_s:.2f} s; "
                            f"an echo through ZeroMQ takes {1e3 * echo_s:.2f} ms"),
                 Row(ALARMS[machine], float(len(stretch.alarms)))]
        if machine is Machine.IDLE:
            rows.append(Row(CPU, sum(stretch.cpu.values())))
        figures["silences"][machine.value] = {name: each._asdict() for name, each in silent.items()}
        figures["scan_to_tf_s"][machine.value] = _distribution(ages_s)
        figures["stop_s"][machine.value] = _distribution([each.brakes_s for each in stretch.stops])
        figures["echo_s"][machine.value] = _distribution(stretch.echoes_s)
        figures["cpu"][machine.value] = stretch.cpu
    return rows, figures


def restart_row(made: Sequence[Restart]) -> Row:
    """Of all deaths of nodes."""
    recovered_s = [each.recovered_s for each in made if each.recovered_s is not None]
    return Row(RESTARTS, len(recovered_s) / len(made),
               remark=f"{len(made)} killed; at the latest after {max(recovered_s, default=0.0):.1f} s")


def _distribution(values: Sequence[float]) -> Dict[str, float]:
    return {"median": _quantile(values, 0.5), "p99": _quantile(values, 0.99), "max": max(values)}


def _quantile(values: Sequence[float], part: float) -> float:
    """One of the values, so that what never came, infinity, is one too."""
    return sorted(values)[math.ceil(part * len(values)) - 1]
