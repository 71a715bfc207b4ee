"""Campaigns: no run is repeated, failures are stored with their log, and all results reach store and CI."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
from xml.etree import ElementTree

import measured
import pytest
import yaml
from distributed import Client

from mtr_campaign import cli
from mtr_campaign.errors import CampaignError
from mtr_campaign.kernels import registry
from mtr_campaign.kernels.outcome import Outcome
from mtr_campaign.kernels.stack import StackKernel
from mtr_campaign.plan.plan import plan_from
from mtr_campaign.work import crew, one_run
from mtr_campaign.work.conductor import Conductor, Course
from mtr_campaign.work.crew import DaskCrew, Here
from mtr_campaign.work.folder import CampaignFolder
from mtr_campaign.work.optimiser import figure_of
from mtr_operator.domain.errors import OperatorError
from mtr_operator.storage.lock import Lock

PLAN = {"name": "camp", "kernel": "counting", "scenario": "autolock", "vary": {"seed": {"from": 1, "to": 5}}}


class CountingKernel:
    """Kernel that simulates nothing and records the requested seeds."""

    name = "counting"
    seeds = []
    broken = ()

    def check(self, order):
        """Accept every order."""

    def run(self, order, folder, digest):
        self.seeds.append(order.seed)
        (folder / "note.txt").write_text(digest, encoding="utf-8")
        if order.seed in self.broken:
            raise OperatorError("The Car fell silent.")
        far_m = order.car.honest.antennas[0].x_m
        return Outcome({"unlock_mean_m": 1.0 + order.seed}, {"unlock": {"1": 1.0 + far_m, "2": None}})


@pytest.fixture(name="kernel")
def kernel_fixture(monkeypatch):
    """Register the counting kernel."""
    kernel = type("Kernel", (CountingKernel,), {"seeds": [], "broken": ()})
    monkeypatch.setitem(registry._KERNELS, "counting", kernel)
    return kernel


@pytest.fixture(name="folder")
def folder_fixture(tmp_path):
    """Return the folder of the campaign."""
    made = CampaignFolder(tmp_path / "camp")
    made.make()
    return made


def campaign(folder, **changes):
    course = Course()
    Conductor(plan_from({**PLAN, **changes}, "camp"), folder, Here()).run(course)
    return course


def test_what_is_done_is_not_run_again(kernel, folder):
    assert campaign(folder).known == 0 and kernel.seeds == [1, 2, 3, 4, 5]
    course = campaign(folder, vary={"seed": {"from": 3, "to": 7}})
    assert kernel.seeds == [1, 2, 3, 4, 5, 6, 7] and course.known == 3 and len(course.runs) == 5


def test_no_run_is_lost_of_more_than_wait_with_the_scheduler(kernel, folder, monkeypatch):
    monkeypatch.setattr(crew, "_WAITING_PER_WORKER", 2)
    course = Course()
    with Client(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as client:
        Conductor(plan_from({**PLAN, "vary": {"seed": {"from": 1, "to": 7}}}, "camp"), folder,
                  DaskCrew(client)).run(course)
    assert sorted(kernel.seeds) == [1, 2, 3, 4, 5, 6, 7] and len(course.runs) == 7 and not course.failed


def test_failure_is_kept_with_its_log_and_run_again_and_stops_no_other(kernel, folder):
    kernel.broken = (2,)
    course = campaign(folder)
    (failed,) = course.failed
    assert failed.reason == "The Car fell silent." and len(course.runs) == 5
    assert "OperatorError" in (folder.of_run(failed.digest) / "log.txt").read_text(encoding="utf-8")
    kernel.broken, kernel.seeds[:] = (), []
    assert not campaign(folder).failed and kernel.seeds == [2]


def test_summary_and_junit_tell_each_run(kernel, folder):
    kernel.broken = (4,)
    campaign(folder)
    summary = json.loads((folder.path / "campaign.json").read_text(encoding="utf-8"))
    assert (summary["runs"], summary["failed"]) == (5, 1)
    assert {row["settings"]["seed"]: row["status"] for row in summary["table"]}[4] == "failed"
    suite = ElementTree.parse(folder.path / "junit.xml").getroot()
    assert (suite.get("tests"), suite.get("failures")) == ("5", "1")
    assert [case.find("failure").get("message") for case in suite if case.find("failure") is not None] == [
        "The Car fell silent."]


def test_of_two_workers_with_the_same_run_the_first_one_stays(kernel, folder):
    run = next(plan_from(PLAN, "camp").runs())
    place = folder.of_run(run.digest)
    with folder.begun(run.digest) as late:
        one_run.execute(run.to_document(), str(folder.path))
        first = (place / "run.json").read_bytes()
        (late / "run.json").write_text("{}", encoding="utf-8")
    assert (place / "run.json").read_bytes() == first
    assert [each.name for each in (folder.path / "runs").iterdir()] == [run.digest]


def test_what_a_killed_worker_leaves_is_removed_and_run_anew(kernel, folder):
    left = folder.path / "runs" / ".begun-abc-1"
    left.mkdir()
    assert folder.forget_begun() == 1 and not left.exists()
    torn = folder.of_run(next(plan_from(PLAN, "camp").runs()).digest)
    torn.mkdir()
    (torn / "run.json").write_text('{"digest": ', encoding="utf-8")
    assert campaign(folder).known == 0 and kernel.seeds[0] == 1


def test_optimiser_asks_for_the_same_again_and_finds_what_is_wanted(kernel, folder):
    wanted = {"vary": {"antennas.left_door.x_m": {"low": -1.0, "high": 1.0}}, "design": {
        "kind": "optimise", "runs": 25, "seed": 3, "figure": "unlock", "aim": "wanted", "wanted": 1.5}}
    course = campaign(folder, **wanted)
    plan = plan_from({**PLAN, **wanted}, "camp")
    best = min(course.runs.values(), key=lambda done: figure_of(plan, done))
    # Line 2 is never known and counts as a deviation by the whole target.
    assert best.outcome["distances"]["unlock"]["1"] == pytest.approx(1.5, abs=0.1)
    assert campaign(folder, **wanted).known == 25
    with pytest.raises(CampaignError, match="colour is no figure of the test; there are unlock_mean_m"):
        campaign(folder, **{**wanted, "design": {**wanted["design"], "figure": "colour", "aim": "maximise"}})


def test_command_runs_a_plan_into_store_and_folder_and_goes_on(tmp_path, capsys):
    path = tmp_path / "plan.yaml"
    path.write_text("name: two\nscenario: autolock\nset: {car: honest, parameters.measurements_distance_m: 10.0}\n"
                    "vary: {seed: [1, 2]}\n", encoding="utf-8")
    arguments = ["run", str(path), "--out", str(tmp_path / "out"), "--workers", "0", "--json"]
    for known in (0, 2):
        assert cli.main(arguments) == 0
        told = json.loads(capsys.readouterr().out)
        assert (told["runs"], told["known"], told["failed"]) == (2, known, 0)
    from mtr_results.store import reading
    from mtr_results.store.place import Place
    with Place(told["store"]).open().reading() as connection:
        assert len(reading.find(connection, reading.Search(campaign="two"))) == 2


def test_command_says_what_is_wrong_and_runs_nothing(tmp_path, capsys):
    path = tmp_path / "plan.yaml"
    path.write_text("scenario: autolock\nvary: {colour: [1]}\n", encoding="utf-8")
    assert cli.main(["run", str(path), "--out", str(tmp_path / "out"), "--workers", "0"]) == 2
    assert "The setting colour is unknown" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
    path.write_text("scenario: autolock\nvary: {seed: [1]}\n", encoding="utf-8")
    assert cli.main(["run", str(path), "--out", str(tmp_path / "out"), "--workers", "-1"]) == 2
    assert "--workers is -1; allowed are 0 to" in capsys.readouterr().err


def test_one_campaign_is_run_by_one_program_at_a_time(tmp_path, capsys):
    path = tmp_path / "plan.yaml"
    path.write_text("name: two\nscenario: autolock\nvary: {seed: [1]}\n", encoding="utf-8")
    (tmp_path / "out" / "two").mkdir(parents=True)
    with Lock(tmp_path / "out" / "two" / "campaign"):
        assert cli.main(["run", str(path), "--out", str(tmp_path / "out"), "--workers", "0"]) == 2
    assert "Another program runs the campaign in" in capsys.readouterr().err


@pytest.mark.parametrize("writes", [True, False])
def test_whole_stack_is_a_demo_in_a_folder_of_its_own(folder, monkeypatch, writes):
    began = []

    def demo(arguments, log):
        began.append(dict(zip(arguments[::2], arguments[1::2])))
        if writes:
            place = pathlib.Path(began[0]["--out"], "key_press")
            measured.in_folder(place, 5.0, 5.5, 6.0, 6.5)
        return 0

    monkeypatch.setattr(StackKernel, "_demo", staticmethod(demo))
    course = campaign(folder, kernel="stack", scenario="key_press", vary={"seed": [7]}, set={"key.battery_v": 2.5})
    (done,) = course.runs.values()
    assert began[0]["--seed"] == "7" and began[0]["--scenarios"] == "key_press"
    place = folder.of_run(done.digest)
    assert yaml.safe_load((place / "car" / "honest.yaml").read_text(encoding="utf-8"))["key"]["battery_v"] == 2.5
    assert "maximum_distance_m" in (place / "parameters.yaml").read_text(encoding="utf-8")
    if writes:
        assert done.outcome["figures"]["press_mean_m"] == pytest.approx(5.75)
    else:
        assert done.reason.endswith("see log.txt in the run's folder.")


def test_check_tells_how_many_runs_there_are(tmp_path, capsys):
    path = tmp_path / "plan.yaml"
    path.write_text("scenario: autolock\nvary: {seed: {from: 1, to: 30}}\n", encoding="utf-8")
    assert cli.main(["check", str(path)]) == 0
    assert "asks for 30 runs of autolock by the kernel radio" in capsys.readouterr().out
