"""Arrival times of the nodes' messages: silences beyond the nodes' promised periods."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Mapping, NamedTuple, Sequence

import numpy as np

from mtr_core import names, schedule
from mtr_core.schedule import Slot

NS = 1e-9


class Voice(NamedTuple):
    """Topic that a node publishes at its ticks, and their slot. asked_by: each message answers one of that voice."""

    topic: str
    slot: Slot
    asked_by: str = ""


SENSORS = "simulator"


VOICES: Mapping[str, Voice] = {
    "drive_control": Voice(names.DRIVE_STATUS, schedule.DRIVE_CONTROL),
    "localization": Voice(names.LOCALIZED_POSE, schedule.LOCALIZATION, SENSORS),
    "motion_planner": Voice(names.MOTION_STATUS, schedule.MOTION_PLANNER),
    "car_locator": Voice(names.CAR_ESTIMATE, schedule.CAR_LOCATOR),
    "state_machine": Voice(names.ROBOT_MODE, schedule.STATE_MACHINE),
    "peripherals": Voice(names.PERIPHERALS_STATE, schedule.PERIPHERALS),
    "dispatcher": Voice(names.DESIRED_STATE, schedule.DISPATCHER),
    "controller_input": Voice(names.MOTION_LOCK, schedule.CONTROLLER_INPUT),
}
# Inputs of the nodes; their silence is not counted against the nodes.
ASKING: Mapping[str, Voice] = {SENSORS: Voice(names.WHEEL_ODOMETRY, schedule.SENSORS)}


class Silence(NamedTuple):
    """Gaps between a node's messages, in s.

    Attributes:
        due_s: longest allowed gap: the node's period, or the longest gap of its input.
        late: excess of the longest gap over due_s, as a share of the period.
    """

    period_s: float
    messages: int
    median_s: float
    p99_s: float
    longest_s: float
    due_s: float
    late: float


def silence(times_s: Sequence[float], begin_s: float, end_s: float, period_s: float,
            asked_s: float = 0.0) -> Silence:
    """Return the silence within an interval of arrivals on a steady clock; gaps at its ends count.

    asked_s: longest silence of the node's input.
    """
    within = [time_s for time_s in times_s if begin_s <= time_s <= end_s]
    gaps_s = np.diff([begin_s, *within, end_s])
    longest_s, due_s = float(np.max(gaps_s)), max(period_s, asked_s)
    return Silence(period_s, len(within), float(np.median(gaps_s)), float(np.quantile(gaps_s, 0.99)), longest_s, due_s,
                   (longest_s - due_s) / period_s)


def silences(arrivals: Mapping[str, Sequence[float]], begin_s: float, end_s: float) -> Dict[str, Silence]:
    """Return the silences of all nodes and of their inputs."""
    asking = {name: silence(arrivals[name], begin_s, end_s, voice.slot.period_ns * NS)
              for name, voice in ASKING.items()}
    nodes = {node: silence(arrivals[node], begin_s, end_s, voice.slot.period_ns * NS,
                           asking[voice.asked_by].longest_s if voice.asked_by else 0.0)
             for node, voice in VOICES.items()}
    return {**nodes, **asking}


def by_node(callers: Mapping[str, Mapping[str, List[float]]]) -> Dict[str, List[float]]:
    """Return arrivals by node from arrivals by topic and caller."""
    return {node: callers.get(voice.topic, {}).get(f"/{node}", []) for node, voice in {**VOICES, **ASKING}.items()}
