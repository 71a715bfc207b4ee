"""Kernel cores: a whole test in one process, stored like any other, and deterministic for a seed."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_campaign.kernels.cores.car_port import DirectPort
from mtr_campaign.kernels.order import order_of
from mtr_campaign.kernels.registry import kernel_of
from mtr_campaign.plan.run import Run
from mtr_campaign.work.folder import FAILED, LOG_FILE, CampaignFolder
from mtr_campaign.work.one_run import execute
from mtr_operator.car_link.drivers.in_process import InProcessCarLink
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import FILE_NAME, open_progress

# Two radials, in front of and behind the Car.
SHORT = {"car": "honest_button", "seed": 3, "parameters.minimum_distance_m": 3.0, "parameters.maximum_distance_m": 9.0,
         "parameters.interval_m": 0.5, "parameters.attempts_limit": 8, "parameters.angle_between_radials_deg": 180.0}


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """Return the outcome of a short test, and its folder."""
    folder = tmp_path_factory.mktemp("cores")
    run = Run("cores", "key_press", SHORT)
    return kernel_of("cores").run(order_of(run), folder, run.digest), folder


def test_test_is_measured_to_its_end_and_kept(ran):
    outcome, folder = ran
    assert outcome.figures["lines"] == 2 and outcome.figures["invalid"] == 0
    assert 30.0 < outcome.figures["robot_s"] < 600.0
    scenario, parameters, progress, *_ = open_progress(folder / FILE_NAME, SCENARIOS)
    assert scenario.name == "key_press" and len(progress.results) == 2
    assert progress.car is not None and progress.car.length == pytest.approx(4.5, abs=0.1)
    assert progress.kept is not None and progress.identity.car_model == "simulated honest_button"


def test_robot_presses_at_the_distances_that_it_was_asked_for(ran):
    outcome, folder = ran
    results = open_progress(folder / FILE_NAME, SCENARIOS)[2].results
    worked, failed = ([place_m for result in results for place_m in places_of(result)] for places_of in (
        lambda result: result.worked_at_m, lambda result: result.failed_at_m))
    assert worked and failed and len(worked) + len(failed) >= 8
    assert all(2.9 < place_m < 9.1 for place_m in worked + failed)


def test_true_events_are_kept_beside_the_test(ran):
    text = (ran[1] / "truth_events.csv").read_text(encoding="utf-8")
    assert text.count("press") >= 8


def test_failure_of_a_run_is_kept_with_its_log(tmp_path, monkeypatch):
    def fail(robot):
        raise RuntimeError("A part of the robot has a defect.")

    monkeypatch.setattr("mtr_simulation.cores.robot.CoresRobot.next_status", fail)
    folder = CampaignFolder(tmp_path / "camp")
    folder.make()
    done = folder.done(execute(Run("cores", "key_press", SHORT).to_document(), str(folder.path)))
    assert done is not None and done.status == FAILED and "has a defect" in done.reason
    log, = folder.path.rglob(LOG_FILE)
    assert "next_status" in log.read_text(encoding="utf-8")


def test_frames_of_the_application_reach_the_car_once():
    port = DirectPort()
    port.send(0x100, b"\1", 5)
    port.take(0x321, b"\2")
    assert [(frame.can_id, frame.data) for frame in port.taken()] == [(0x321, b"\2")] and port.taken() == []


def test_nobody_waits_for_frames_that_come_in_the_same_thread(monkeypatch):
    now_s, message, waited = [0.0], DemoLockMessage(), []
    link = InProcessCarLink("mtr_demo_car", lambda: now_s[0], lambda *_: None)
    link.connect()
    monkeypatch.setattr(link._changed, "wait", waited.append)
    for step in range(1, 200):
        now_s[0] = 0.02 * step
        # No frames during the last 0.4 s, which is shorter than the limit of a silent bus.
        if step < 180:
            link.received(0x320, message.next(), round(now_s[0] * 1e9))
        if step % 5 == 0:
            link.observe(RobotStatus(step, 1, now_s[0], waits_for_answer=True))
    assert link.lock_state is not LockState.UNKNOWN and not any(waited)
    link.close()
