"""Plans: the resulting runs, and one sentence for each invalid plan."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_campaign.errors import CampaignError
from mtr_campaign.kernels.registry import check_plan, kernel_of
from mtr_campaign.plan.plan import MAX_RUNS, load_plan, plan_from
from mtr_campaign.plan.run import Run, run_from
from mtr_campaign.studies.plans import shipped_plan

GRID = {"name": "small", "scenario": "autolock", "set": {"car": "honest"},
        "vary": {"seed": {"from": 1, "to": 3}, "key.battery_v": [3.0, 2.4]}}


# YAML supports integers of any size; this one exceeds the range of floats.
HUGE = 10 ** 400


def plan(**changes):
    return plan_from({**GRID, **changes}, "unnamed")


def test_grid_is_all_combinations_each_once():
    runs = list(plan().runs())
    assert len(runs) == plan().size == 6
    assert {(run.settings["seed"], run.settings["key.battery_v"]) for run in runs} == {
        (seed, volts) for seed in (1, 2, 3) for volts in (3.0, 2.4)}
    assert all(run.settings["car"] == "honest" for run in runs)


def test_run_is_known_by_what_it_is():
    first, second = Run("radio", "autolock", {"seed": 1, "car": "honest"}), Run("radio", "autolock", {
        "car": "honest", "seed": 1})
    assert first.digest == second.digest == run_from(first.to_document()).digest
    others = [Run("stack", "autolock", first.settings), Run("radio", "key_press", first.settings),
              Run("radio", "autolock", {**first.settings, "seed": 2})]
    assert len({first.digest, *(other.digest for other in others)}) == 4


def test_run_on_a_car_of_a_file_is_another_one_when_the_file_changes(tmp_path):
    run = Run("radio", "autolock", {"car": str(tmp_path / "mine.yaml")})
    (tmp_path / "mine.yaml").write_text("model: honest", encoding="utf-8")
    before = run.digest
    assert run.digest == before
    (tmp_path / "mine.yaml").write_text("model: gentle", encoding="utf-8")
    assert run.digest != before


def test_latin_hypercube_has_each_part_of_each_range_once_and_the_same_again():
    wanted = plan(vary={"key.battery_v": {"low": 2.0, "high": 3.0}, "seed": {"from": 1, "to": 10}},
                  design={"kind": "latin_hypercube", "runs": 10, "seed": 4})
    runs = list(wanted.runs())
    volts = sorted(run.settings["key.battery_v"] for run in runs)
    assert [int((value - 2.0) * 10.0) for value in volts] == list(range(10))
    assert sorted(run.settings["seed"] for run in runs) == list(range(1, 11))
    assert [run.digest for run in wanted.runs()] == [run.digest for run in runs]


def test_sobol_asks_for_saltellis_samples_and_normal_factors_stay_within_three_sigmas():
    wanted = plan(vary={"errors.clock_s": {"mean": 0.0, "sigma": 0.01}, "errors.inset_m": {"low": 0.0, "high": 0.06}},
                  design={"kind": "sobol", "samples": 8, "seed": 1})
    runs = list(wanted.runs())
    assert len(runs) == wanted.size == 8 * 4
    assert all(abs(run.settings["errors.clock_s"]) <= 0.03 for run in runs)


@pytest.mark.parametrize("changes, sentence", [
    ({"vary": {"seed": {"from": 1, "to": 1000}, "place": {"from": 1, "to": 1_000_000}}},
     f"asks for 1000000000 runs; allowed are 1 to {MAX_RUNS}"),
    ({"vary": {"seed": {"from": 1, "to": 10**9}}}, "seed has 1000000000 values; allowed are at most"),
    ({"scenario": "parking"}, "scenario is 'parking'; allowed is autolock"),
    ({"colour": "red"}, "Entry colour is unknown; allowed are name"),
    ({"name": "a/b"}, "name is 'a/b'; allowed are up to 64 letters"),
    ({"vary": {"seed": [1, 1]}}, "hold one twice"),
    ({"vary": {"seed": {"low": 1}}}, "allowed is a list of values"),
    ({"vary": {"seed": {"low": 2.0, "high": 1.0}}}, "low has to be the smaller one"),
    ({"vary": {"car": ["honest"]}}, "car is under set and under vary"),
    ({"vary": {"key.battery_v": {"low": 2.0, "high": 3.0}}}, "key.battery_v is a range, of which a grid"),
    ({"design": {"kind": "guess"}}, "The design is 'guess'; allowed is grid"),
    ({"design": {"kind": "sobol", "samples": 6}}, "samples is 6; allowed is a power of two"),
    ({"design": {"kind": "optimise", "runs": 5}}, "An optimisation needs a figure"),
    ({"design": {"kind": "latin_hypercube", "runs": "many"}}, "Entry runs of the design is 'many'"),
    ({"design": {"kind": "grid", "runs": 4}}, "Entry runs of the design grid is unknown"),
    ({"vary": {}, "design": {"kind": "latin_hypercube", "runs": 4}}, "needs something under vary"),
    ({"set": 3}, "set is 3; allowed is a table"),
    ({"vary": {f"place{number}": {"from": 1, "to": 10 ** 6} for number in range(800)}}, "asks for more than 10"),
    ({"vary": {"seed": {"from": 1, "to": HUGE}}}, "seed has more than 10"),
    ({"vary": {"key.battery_v": {"low": 0, "high": HUGE}}}, "allowed is a list of values"),
    ({"vary": {"key.battery_v": {"mean": 0, "sigma": HUGE}}}, "allowed is a list of values"),
    ({"vary": {"key.battery_v": [HUGE]}}, "allowed is a list of values"),
    ({"set": {"errors.clock_s": HUGE}}, "errors.clock_s is 1000"),
    ({"design": {"kind": "latin_hypercube", "runs": HUGE}}, "asks for more than 10"),
    ({"design": {"kind": "latin_hypercube", "runs": 3, "seed": -1}}, "seed of the design is -1; allowed is 0 to"),
    ({"design": {"kind": "optimise", "runs": 3, "figure": "lines", "seed": HUGE}}, "seed of the design is 1000"),
    ({"design": {"kind": "optimise", "runs": 3, "figure": "lines", "wanted": float("nan")}}, "allowed is a number")])
def test_plan_that_cannot_be_is_a_sentence(changes, sentence):
    with pytest.raises(CampaignError) as caught:
        plan(**changes)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("settings, sentence", [
    ({"colour": ["red"]}, "The setting colour is unknown; allowed are car, seed, place, and names that begin with"),
    ({"key.batery_v": [3.0]}, "Parameter batery_v is unknown; allowed are"),
    ({"key.battery_v": [3.0, 9.0]}, "key.battery_v is 9"),
    ({"parameters.passses": [1]}, "Parameter passses is unknown; did you mean passes?"),
    ({"parameters.passes": [0]}, "passes"),
    ({"errors.clock": [0.0]}, "Parameter clock is unknown; allowed are clock_s"),
    ({"antennas.roof.x_m": [0.0]}, "Antenna roof is unknown"),
    ({"seed": [-1]}, "The setting seed is -1; allowed is a whole number from 0"),
    ({"seed": ["many"]}, "The setting seed is 'many'")])
def test_setting_that_is_not_known_or_not_possible_is_a_sentence_before_anything_runs(settings, sentence):
    with pytest.raises(CampaignError) as caught:
        check_plan(plan(vary=settings))
    assert sentence in str(caught.value)


@pytest.mark.parametrize("changes, sentence", [
    ({"kernel": "magic"}, "The kernel is 'magic'; allowed is radio, cores, stack."),
    ({"set": {"car": "gentle"}, "vary": {"seed": [1]}}, "The Car gentle has no radio that could be followed alone"),
    ({"set": {"car": "unreal"}, "vary": {"seed": [1]}}, "Parameter car is 'unreal'"),
    ({"kernel": "stack", "vary": {"errors.clock_s": [0.0]}}, "The setting errors.clock_s is of the kernel radio"),
    ({"kernel": "cores", "vary": {"errors.clock_s": [0.0]}}, "The setting errors.clock_s is of the kernel radio")])
def test_kernel_says_what_it_cannot_run(changes, sentence):
    with pytest.raises(CampaignError) as caught:
        check_plan(plan(**changes))
    assert sentence in str(caught.value)


def test_whole_stack_takes_what_the_radio_takes():
    check_plan(plan(kernel="stack"))
    assert kernel_of("stack").name == "stack"


@pytest.mark.parametrize("text, sentence", [(None, "cannot be read: No such file"), ("a: [", "is not valid YAML"),
                                            ("[]", "It has to consist of lines")])
def test_file_that_is_no_plan_is_a_sentence_with_its_name(tmp_path, text, sentence):
    path = tmp_path / "plan.yaml"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(CampaignError) as caught:
        load_plan(path)
    assert sentence in str(caught.value) and str(path) in str(caught.value)


@pytest.mark.parametrize("name", ["antennas", "sensors"])
def test_plans_of_the_studies_that_ship_are_possible(name):
    check_plan(shipped_plan(name))
