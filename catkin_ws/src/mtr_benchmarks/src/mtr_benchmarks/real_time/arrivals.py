"""When the nodes spoke: how long each was silent, beyond the period that it promises."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Mapping, NamedTuple, Sequence

import numpy as np

from mtr_core import names, schedule
from mtr_core.schedule import Slot

NS = 1e-9


class Voice(NamedTuple):
    """A topic on which a node speaks at its ticks, and their slot; asked_by: it answers each message of that voice."""

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
# What speaks besides, so that nobody is blamed for its silence.
ASKING: Mapping[str, Voice] = {SENSORS: Voice(names.WHEEL_ODOMETRY, schedule.SENSORS)}


class Silence(NamedTuple):
    """Gaps between a node's messages, in s.

    Attributes:
        due_s: after which it has to speak again: its period, or the longest gap of what it answers.
        late: by how much of its period the longest gap was longer than that.
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
    """Of arrivals on a steady clock in a stretch of it; one that ends or begins in silence counts that.

    asked_s: longest silence of what it answers.
    """
    within = [time_s for time_s in times_s if begin_s <= time_s <= end_s]
    gaps_s = np.diff([begin_s, *within, end_s])
    longest_s, due_s = float(np.max(gaps_s)), max(period_s, asked_s)
    return Silence(period_s, len(within), float(np.median(gaps_s)), float(np.quantile(gaps_s, 0.99)), longest_s, due_s,
                   (longest_s - due_s) / period_s)


def silences(arrivals: Mapping[str, Sequence[float]], begin_s: float, end_s: float) -> Dict[str, Silence]:
    """Of all nodes, and of what asks them."""
    asking = {name: silence(arrivals[name], begin_s, end_s, voice.slot.period_ns * NS)
              for name, voice in ASKING.items()}
    nodes = {node: silence(arrivals[node], begin_s, end_s, voice.slot.period_ns * NS,
                           asking[voice.asked_by].longest_s if voice.asked_by else 0.0)
             for node, voice in VOICES.items()}
    return {**nodes, **asking}


def by_node(callers: Mapping[str, Mapping[str, List[float]]]) -> Dict[str, List[float]]:
    """Arrivals by topic and caller as arrivals by node."""
    return {node: callers.get(voice.topic, {}).get(f"/{node}", []) for node, voice in {**VOICES, **ASKING}.items()}
