"""Procedures of the hazard file are items of the application's checklist or sections of `docs/safe-operation.md`."""
# SPDX-License-Identifier: Apache-2.0
import hazard_file as model
import hazard_tables as page
import pytest
from test_documents import anchors

from mtr_operator.station.checks.finding import Check

FILE = model.read()
PROCEDURES = [measure for measure in model.measures(FILE) if measure.type == model.PROCEDURE]
DESCRIBED = [measure for measure in model.measures(FILE) if measure.type == model.HARDWARE and measure.where]
MAX_LINES = 150


@pytest.mark.parametrize("measure", PROCEDURES, ids=lambda measure: measure.id)
def test_procedure_is_an_item_of_the_checklist_or_a_section_of_the_page(measure):
    kind, _, name = measure.where.partition(":")
    assert kind in ("checklist", "page")
    assert name in (Check.__members__ if kind == "checklist" else anchors(page.OPERATION))


@pytest.mark.parametrize("measure", DESCRIBED, ids=lambda measure: measure.id)
def test_described_hardware_is_a_section_of_its_page(measure):
    kind, _, name = measure.where.partition(":")
    assert kind == "hardware" and name in anchors(model.TOP / "docs" / "hardware.md")


@pytest.mark.parametrize("measure", PROCEDURES, ids=lambda measure: measure.id)
def test_procedure_that_no_checklist_asks_for_is_open(measure):
    assert (measure.status == model.DONE) == measure.where.startswith("checklist:")


def test_page_of_safe_operation_is_short_enough_to_be_read():
    assert len(page.OPERATION.read_text(encoding="utf-8").splitlines()) <= MAX_LINES


def test_every_operating_condition_has_a_limit_and_a_reason():
    assert all(set(each) == {"limit", "reason"} and all(each.values()) for each in FILE.odd.values())


def test_what_no_sensor_shows_is_a_procedure():
    """The items that a person has to check are measures of hazards."""
    from mtr_operator.station.checks.checklist import UNSEEN

    asked = {measure.where.partition(":")[2] for measure in PROCEDURES if measure.where.startswith("checklist:")}
    assert {check.name for check in UNSEEN} <= asked
