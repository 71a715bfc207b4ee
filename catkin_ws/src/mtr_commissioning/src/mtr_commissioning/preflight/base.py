"""Checks the base's own controller: the mast must survive a stop without drive control.

Drive control alone decides which limits it accepts, at its start, and publishes the reason of a rejection. This module
compares the base's current parameters with the shipped ones, because they may have been changed after that.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, Iterator, List, Optional, Tuple

from mtr_description.base_controller import BaseController
from mtr_motion_check.finding import Finding, bad, good

from .expected import Setup
from .records import RobotRecord

LIMITS, START, PARAMETERS, E_STOPS = "base.limits", "node.start", "node.parameters", "base.e_stops"
HINT = "load mtr_description/config/jackal_base.yaml before the base's controller starts, see docs/robot-motion.md"


def start_findings(record: RobotRecord) -> List[Finding]:
    """Report nodes that could not start, with their own sentences."""
    return [bad(START, node, f"It cannot start. {why}") for node, why in sorted(record.start_failures.items())]


def parameter_findings(record: RobotRecord) -> List[Finding]:
    """Report node_parameters of unknown nodes, and the emergency stops in the robot's parameters."""
    # A node in a namespace has its parameters there.
    known = {node.split("/")[0] for node in (*record.nodes, *record.start_failures)}
    found = [bad(PARAMETERS, node, "The file of node_parameters names it, but no node of this name runs, so that what "
                 "it says there counts for nothing: correct the name, or remove it.")
             for node in sorted(record.node_parameters) if node not in known]
    stops = f"the emergency stops {', '.join(record.e_stop_topics)}" if record.e_stop_topics else (
        "no emergency stop on a topic of its own")
    return [*found, good(E_STOPS, "e_stop_topics", f"Drive control listens to {stops}.")]


def base_findings(record: RobotRecord, setup: Setup, shipped: BaseController) -> List[Finding]:
    """Check the parameters of the base, or of the node in front of it."""
    where = setup.base_parameters
    if record.base is None:
        if setup.is_simulated:
            return [good(LIMITS, where, "There are no parameters of the base; the simulated one has those that ship.")]
        return [bad(LIMITS, where, f"There are no parameters of the base, which drive control needs: {HINT}.")]
    problems = [*switch_problems(where, record.base), *value_problems(where, record.base, shipped)]
    return problems or [good(LIMITS, where, "The base stops no harder and no later than the shipped one, and brakes as "
                             "hard as drive control does.")]


def switch_problems(where: str, values: Dict[str, Any]) -> Iterator[Finding]:
    """Report disabled limits, and limits that would delay a stop."""
    for axis in ("linear/x", "angular/z"):
        if value_of(values, f"{axis}/has_acceleration_limits") is not True:
            yield bad(LIMITS, f"{where}/{axis}", "Its has_acceleration_limits is not true, allowed is true: without "
                      f"them a stop tips the mast; {HINT}.")
        if value_of(values, f"{axis}/has_jerk_limits") is True:
            yield bad(LIMITS, f"{where}/{axis}", "Its has_jerk_limits is true, allowed is false: they delay an "
                      f"emergency stop; {HINT}.")


def value_problems(where: str, values: Dict[str, Any], shipped: BaseController) -> Iterator[Finding]:
    """Report numbers that are missing, beyond the shipped ones, or below drive control's deceleration."""
    rows: Tuple[Tuple[str, float, str], ...] = (
        ("cmd_vel_timeout", shipped.command_timeout_s, "s"),
        ("linear/x/max_acceleration", shipped.linear_acceleration_mps2, "m/s2"),
        ("angular/z/max_acceleration", shipped.angular_acceleration_radps2, "rad/s2"))
    for name, limit, unit in rows:
        value = value_of(values, name)
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            yield bad(LIMITS, f"{where}/{name}", f"It is missing, allowed is at most {limit:g} {unit}: {HINT}.", None,
                      limit, unit=unit)
        elif not 0.0 < value <= limit:
            yield bad(LIMITS, f"{where}/{name}", f"It is {value:g} {unit}, allowed is above 0 and at most {limit:g} "
                      f"{unit}, with which the mast was proved: {HINT}.", float(value), limit, unit=unit)


def value_of(values: Dict[str, Any], path: str) -> Optional[Any]:
    """Return the value of nested parameters; None if missing."""
    value: Any = values
    for word in path.split("/"):
        value = value.get(word) if isinstance(value, dict) else None
    return value
