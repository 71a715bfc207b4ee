"""The matrix of states and faults: its file is complete, its codes exist, and docs/faults.md has its table."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest
import yaml

from mtr_benchmarks.faults.matrix import BEGIN, END, GOES_ON, HELD, LOST, read_matrix, table
from mtr_fault_injection.schedule import fault_of

TOP = pathlib.Path(__file__).resolve().parents[2]
MATRIX = read_matrix()
SENTENCES = yaml.safe_load((TOP / "operator_gui/src/mtr_operator/gui/translations/robot_cs.yaml").read_text("utf-8"))
MODES = {"ready_to_map_car", "mapping_car", "following_waypoint", "checking_car", "fault"}


@pytest.mark.parametrize("cell", MATRIX.cells, ids=lambda cell: cell.name)
def test_cell_can_be_run_and_names_what_there_is(cell):
    fault_of(cell.part, cell.kind, cell.for_s, cell.amount, 0.0)
    must = cell.expected
    assert cell.state in MATRIX.states and must.mode in MODES and must.then in (GOES_ON, HELD, LOST)
    assert not must.told or must.told in str(SENTENCES)
    assert 0.0 < must.told_s <= 1.0 and (must.stands_s is None or must.stands_s <= 1.0)


def test_no_cell_is_there_twice_and_some_are_part_of_every_test():
    names = [cell.name for cell in MATRIX.cells]
    assert len(names) == len(set(names)) and any(cell.is_short for cell in MATRIX.cells)


def test_table_of_the_documentation_is_the_matrix():
    page = (TOP / "docs/faults.md").read_text(encoding="utf-8")
    written = page.partition(BEGIN)[2].partition(END)[0].strip().splitlines()
    assert written == table(MATRIX), "write it anew: python -m mtr_benchmarks.faults --table"
