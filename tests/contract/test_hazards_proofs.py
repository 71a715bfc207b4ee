"""Proofs and parameters of the hazard file exist in the sources, with the values that the file states."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import hazard_file as model
import hazard_proofs as proofs
import pytest
import stopping_distances as stopping
import yaml
from code_defaults import defaults, folder

MEASURES = model.measures(model.read())
DONE = [measure for measure in MEASURES if measure.status == model.DONE]


@pytest.mark.parametrize("measure", [each for each in MEASURES if each.proofs], ids=lambda measure: measure.id)
def test_every_proof_exists(measure):
    assert [proof for proof in measure.proofs if not proofs.exists(proof)] == []
    assert len(set(measure.proofs)) == len(measure.proofs)


@pytest.mark.parametrize("proof", ["gtest:Blindness.NoSuchTest", "pytest:test_hazards::test_nothing", "record:never",
                                   "cell:front_lidar off while flying", "row:motion: no such row", "sentence"])
def test_proof_that_does_not_exist_is_noticed(proof):
    assert not proofs.exists(proof)


def test_every_kind_of_proof_has_names():
    assert all(len(names()) > 20 for names in proofs.kinds().values())


@pytest.mark.parametrize("measure", [each for each in DONE if each.type == model.SOFTWARE], ids=lambda each: each.id)
def test_place_of_a_measure_exists(measure):
    assert folder(measure.where).exists(), measure.where


@pytest.mark.parametrize("measure", [each for each in MEASURES if each.parameters], ids=lambda measure: measure.id)
def test_parameters_are_the_defaults_of_the_code(measure):
    found = defaults(measure.where)
    for name, value in measure.parameters.items():
        assert found[name] == {value}, f"{name}: {sorted(found[name], key=str)} in {measure.where}"


def test_mutation_groups_safety_run_proofs_of_measures():
    """`make mutants` changes the code of these measures, and their proofs have to notice it."""
    groups = yaml.safe_load((model.TOP / "tests/mutation/groups.yaml").read_text(encoding="utf-8"))["groups"]
    proved = {proof.partition(":")[2].partition("::")[0] for each in DONE for proof in each.proofs}
    safety = {name: group for name, group in groups.items() if name.startswith("safety")}
    assert len(safety) >= 4 and all(group["minimum"] >= 0.95 for group in safety.values())
    for group in safety.values():
        assert {pathlib.Path(path).stem for path in group["tests"]} <= proved
        assert all((model.TOP / group["source"] / path).is_file() for path in group["modules"])


def test_stopping_distances_follow_from_drive_controls_limits():
    core = pytest.importorskip("mtr_drive_control_core")
    for height_m in (stopping.LOW_M, stopping.RAISED_M):
        limits = core.limits_at(height_m)
        wanted = limits["emergency_linear_deceleration_mps2"]
        assert stopping.deceleration_mps2(height_m) == pytest.approx(wanted, rel=1e-9)
        assert min(stopping.fastest_mps(height_m), stopping.value("max_linear_mps", "mtr_drive_control")) \
            == pytest.approx(limits["max_linear_mps"], rel=1e-9)
