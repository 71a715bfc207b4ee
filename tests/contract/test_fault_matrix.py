"""The matrix of states and faults: its file is complete, its codes exist, and docs/fault-matrix.md has its table."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from xml.etree import ElementTree

import pytest
import yaml

from mtr_benchmarks.faults.matrix import (
    ANY_REASON,
    BEGIN,
    END,
    GOES_ON,
    HELD,
    LOST,
    OR,
    STATES,
    UNHEARD,
    left_out,
    read_matrix,
    table,
)
from mtr_benchmarks.faults.robots import ROBOTS
from mtr_fault_injection.parts import catalogue
from mtr_fault_injection.schedule import fault_of
from mtr_fault_injection.set_clock import SettableClock

TOP = pathlib.Path(__file__).resolve().parents[2]
MATRIX, REASONS = read_matrix(), left_out()
SENTENCES = yaml.safe_load((TOP / "operator_gui/src/mtr_operator/gui/translations/robot_cs.yaml").read_text("utf-8"))
# `unknown` where the state machine is silent, `unheard` where no Status comes.
MODES = {"ready_to_map_car", "mapping_car", "following_waypoint", "checking_car", "fault", "unknown", UNHEARD}


@pytest.mark.parametrize("cell", MATRIX.cells, ids=lambda cell: cell.name)
def test_cell_can_be_run_and_names_what_there_is(cell):
    fault_of(cell.part, cell.kind, cell.for_s, cell.amount, 0.0)
    must = cell.expected
    assert cell.state in STATES and set(must.mode.split(OR)) <= MODES
    assert set(must.then.split(OR)) <= {GOES_ON, HELD, LOST}
    assert cell.robot in ROBOTS and all(code in str(SENTENCES) for code in must.told.split(OR))
    assert 0.0 < must.told_s <= 1.0 and (must.stands_s is None or must.stands_s <= 0.5)
    assert must.lift_s is None or must.lift_s <= 1.3
    assert must.may_tell == ANY_REASON or all(code in str(SENTENCES) for code in must.may_tell.split(OR))
    assert not (must.told and must.may_tell) and (must.stands_s is None or not must.may_stand)


def test_every_fault_of_the_catalogue_is_tried_in_every_state_or_left_out_for_a_reason():
    tried = {(cell.part, cell.kind, cell.state) for cell in MATRIX.cells}
    for part, kinds in catalogue().items():
        for kind in kinds:
            missing = [state for state in STATES if (part, kind, state) not in tried]
            reason = REASONS.get(part) or REASONS.get(f"{part} {kind}")
            assert bool(missing) == bool(reason), f"{part} {kind}: {missing or 'left out and tried'}"


def test_no_cell_is_there_twice_and_some_are_part_of_every_test():
    names = [cell.name for cell in MATRIX.cells]
    assert len(names) == len(set(names)) and any(cell.is_short for cell in MATRIX.cells)


def test_table_of_the_documentation_is_the_matrix():
    page = (TOP / "docs/fault-matrix.md").read_text(encoding="utf-8")
    written = page.partition(BEGIN)[2].partition(END)[0].strip().splitlines()
    assert written == table(MATRIX), "write it again: python -m mtr_benchmarks.faults --table"


def test_clock_of_a_fault_is_set_for_nodes_too_that_preload_nothing_else(tmp_path):
    """A node that kept the machine's clock would be silent to all others: it would test what no robot has."""
    variables = SettableClock(tmp_path).variables
    launch = ElementTree.parse(TOP / "launch" / "launch" / "robot" / "operator.launch")
    own = [each.get("value") for each in launch.iter("env") if each.get("name") == "LD_PRELOAD"]
    assert own
    for value in own:
        name = re.fullmatch(r"\$\(optenv (\w+)\)", value).group(1)
        assert variables[name] == variables["LD_PRELOAD"]


@pytest.mark.parametrize("kind", ROBOTS)
def test_robots_of_the_matrix_are_started_with_what_the_launch_file_takes(kind):
    launch = ElementTree.parse(TOP / "launch" / "launch" / "sim.launch").getroot()
    taken = {each.get("name") for each in launch.findall("arg")}
    assert {*ROBOTS[kind].arguments, "fault_disk_folder", "fault_clock_file", "fault_relay_status_port"} <= taken
    handed_on = {each.get("name"): each.get("value") for each in launch.iter("arg") if each.get("value")}
    assert handed_on["fault_disk_folder"] == "$(arg fault_disk_folder)"
