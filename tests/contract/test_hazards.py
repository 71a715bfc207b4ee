"""The hazard file is consistent in itself, its pages show it, and hazards without a proof only become fewer."""
# SPDX-License-Identifier: Apache-2.0
import collections
import re

import hazard_file as model
import hazard_tables as page
import pytest

FILE = model.read()
# Hazards that require PLr c or higher and have no proof. The number may only fall: lower it with the next proof.
MOST_WITHOUT_PROOF = 6
HAZARDS = pytest.mark.parametrize("hazard", FILE.hazards, ids=lambda hazard: hazard.id)
MEASURES = pytest.mark.parametrize("measure", model.measures(FILE), ids=lambda measure: measure.id)


def test_ids_are_unique_and_in_order():
    ids = [hazard.id for hazard in FILE.hazards]
    assert all(re.fullmatch(r"H\d\d", each) for each in ids) and ids == sorted(set(ids))
    counted = collections.Counter(measure.id for measure in model.measures(FILE))
    assert max(counted.values()) == 1


@HAZARDS
def test_measures_are_numbered_by_their_hazard(hazard):
    wanted = [f"M{hazard.id[1:]}{letter}" for letter in "abcdefghij"[:len(hazard.measures)]]
    assert [measure.id for measure in hazard.measures] == wanted


@HAZARDS
def test_references_of_a_hazard_resolve(hazard):
    assert hazard.losses and set(hazard.losses) <= set(FILE.losses)
    assert set(hazard.functions) <= set(FILE.functions) and hazard.causes and hazard.left
    assert all(each.action in model.ACTIONS and each.kind in model.KINDS and each.when for each in hazard.controls)
    assert hazard.evidence in model.EVIDENCE and set(hazard.residual.sites) <= set(model.SITES)
    for risk in (hazard.risk, hazard.residual.risk):
        assert {risk.severity, risk.exposure, risk.avoidance} <= {1, 2}


@MEASURES
def test_measure_is_whole(measure):
    assert measure.type in model.TYPES and measure.status in (model.DONE, model.OPEN) and measure.what
    if measure.status == model.OPEN:
        assert not measure.proofs and not measure.parameters
    elif measure.type in (model.HARDWARE, model.SOFTWARE):
        assert measure.proofs and measure.where


def test_every_loss_and_function_belongs_to_a_hazard():
    assert set(FILE.losses) == {loss for hazard in FILE.hazards for loss in hazard.losses}
    assert set(FILE.functions) == {name for hazard in FILE.hazards for name in hazard.functions}


def test_required_level_of_a_function_is_that_of_the_risk_graph_or_higher_at_other_sites():
    for function in FILE.functions.values():
        levels = [function["plr"][site] for site in model.SITES]
        assert levels == sorted(levels) and set(levels) <= {*model.LEVELS, "-"}


@HAZARDS
def test_evidence_is_what_the_proofs_are(hazard):
    kinds = {proof.partition(":")[0] for measure in hazard.measures if measure.is_proved for proof in measure.proofs}
    assert (hazard.evidence == model.NONE) == (not kinds)
    assert (hazard.evidence in (model.BENCH, model.ROBOT)) == ("record" in kinds)


@HAZARDS
def test_risk_falls_only_by_evidence_from_hardware(hazard):
    if hazard.evidence in (model.NONE, model.SIMULATED):
        assert hazard.residual.risk == hazard.risk


@HAZARDS
def test_remaining_risk_of_d_is_accepted_by_a_person_or_releases_no_site(hazard):
    rest = hazard.residual
    if rest.risk.level in ("d", "e") and not rest.accepted_by:
        assert not rest.sites and rest.reason
    assert not rest.accepted_by or re.search(r"\d{4}-\d\d-\d\d", rest.accepted_by), "name and date"


def test_hazards_without_a_proof_only_become_fewer():
    without = [hazard.id for hazard in FILE.hazards if hazard.risk.level >= "c" and not hazard.is_proved]
    assert len(without) == MOST_WITHOUT_PROOF, f"{without}: store the new number if it is lower"


@pytest.mark.parametrize("path, name", [(path, name) for path, made in page.tables().items() for name in made],
                         ids=lambda each: getattr(each, "name", each))
def test_page_shows_the_file(path, name):
    made = page.tables()[path][name](FILE)
    assert page.written(path, name) == made, "write it again: python tests/contract/hazard_tables.py"
