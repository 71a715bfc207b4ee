"""Each fault that can be injected, each problem code that stops the robot and each unsafe control action has a hazard
or a reason why it has none."""
# SPDX-License-Identifier: Apache-2.0
import re
from typing import Dict, Iterable, Iterator, Mapping, Set, Tuple

import hazard_file as model
import pytest
from test_problems import PACKAGES, ROWS

from mtr_fault_injection.parts import catalogue

FILE = model.read()
# Packages that own a motion lock, a hold, or the stop of lift and servos: each of their sentences counts.
LOCKING = {"mtr_controller_input", "mtr_drive_control", "mtr_graph_watch", "mtr_peripherals", "mtr_state_machine"}
DISPATCHER = PACKAGES / "mtr_dispatcher/src/mtr_dispatcher"
# Modules of the dispatcher on control of the robot and on service mode.
OWNERS = (DISPATCHER / "session.py", DISPATCHER / "service/mode.py")


def spread(table: Mapping[str, object], whole: Mapping[str, Iterable[str]]) -> Iterator[Tuple[str, str]]:
    """Pairs of a table with `all` or a list for each name."""
    for name, chosen in table.items():
        assert name in whole, name
        kinds = whole[name] if chosen == model.ALL else chosen
        assert isinstance(kinds, (list, tuple)) and set(kinds) <= set(whole[name]), f"{name}: {kinds}"
        yield from ((name, kind) for kind in kinds)


def named_faults() -> Tuple[Set[Tuple[str, str]], Set[Tuple[str, str]]]:
    """Faults of hazards, and those with a reason."""
    return ({each for hazard in FILE.hazards for each in spread(hazard.faults, catalogue())},
            {each for entry in FILE.not_hazardous for each in spread(entry.get("faults", {}), catalogue())})


def locking_codes() -> Set[str]:
    """Codes of sentences with which a node locks or holds the robot."""
    names = {name for path in OWNERS for name in re.findall(r"problems\.([A-Z_]+)\(", path.read_text(encoding="utf-8"))}
    of_dispatcher = {row.code for row in ROWS if row.package == "mtr_dispatcher" and row.name in names}
    return {row.code for row in ROWS if row.package in LOCKING} | of_dispatcher


def named_codes() -> Tuple[Set[str], Set[str]]:
    """Codes of hazards, and those with a reason."""
    return ({code for hazard in FILE.hazards for code in hazard.problems},
            {code for entry in FILE.not_hazardous for code in entry.get("problems", ())})


def named_controls() -> Tuple[Set[Tuple[str, str]], Set[Tuple[str, str]]]:
    """Unsafe control actions of hazards, and those with a reason."""
    whole: Dict[str, Tuple[str, ...]] = dict.fromkeys(model.ACTIONS, model.KINDS)
    return ({(each.action, each.kind) for hazard in FILE.hazards for each in hazard.controls},
            {each for entry in FILE.not_hazardous for each in spread(entry.get("controls", {}), whole)})


ALL_FAULTS = {(part, kind) for part, kinds in catalogue().items() for kind in kinds}
ALL_CONTROLS = {(action, kind) for action in model.ACTIONS for kind in model.KINDS}


@pytest.mark.parametrize("wanted, named", [
    (ALL_FAULTS, named_faults), (locking_codes(), named_codes), (ALL_CONTROLS, named_controls)],
    ids=["faults", "problem codes", "control actions"])
def test_each_has_a_hazard_or_a_reason(wanted, named):
    of_hazards, with_reason = named()
    assert of_hazards | with_reason == wanted, sorted((of_hazards | with_reason) ^ wanted)
    assert of_hazards & with_reason == set()


def test_reasons_are_sentences():
    assert all(entry["reason"].endswith(".") and len(entry) > 1 for entry in FILE.not_hazardous)
    assert set().union(*FILE.not_hazardous) == {"faults", "problems", "controls", "reason"}
