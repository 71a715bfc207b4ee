"""A test is recorded with the whole bus, and its distances follow anew from log, poses and profile."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import shutil
import zipfile

import can
import pytest
from replayed import recorded, replayed

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.log.bus_log import BusLog
from mtr_operator.car_link.log.log_car import LogCarLink
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.car_link.profile import PROFILE_FOLDER
from mtr_operator.car_link.spoken_car import SpokenCar
from mtr_operator.cli import main
from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.eventlog.entry import INFO, EventEntry, EventKind
from mtr_operator.domain.ports import BusMark, LockState
from mtr_operator.domain.results.session_record import now
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.storage.recorded.course_file import CourseFile, Moment, Note, read_course
from mtr_operator.storage.recorded.recording import Recording, recorded_runs

AUTOLOCK = {"passes": 1, "measurements_distance_m": 5.0, "self_check": False, "maximum_distance_m": 3.5}
KEY_PRESS = {"angle_between_radials_deg": 180.0, "self_check": False, "method": "scan", "maximum_distance_m": 9.0,
             "approach_distance_m": 1.0}


SLOWER = "cycle_time_s: 0.02", "cycle_time_s: 0.2"


def measured(folder, name, parameters):
    """A whole test of a Car that speaks on its bus, with its recording in the folder."""
    scenario = SCENARIOS[name]
    chosen = scenario.parameters_type.from_mapping({**scenario.parameters_type.proposed(), **parameters})
    # A tenth of the frames of the demo car.
    slow = profile(folder)
    return recorded(folder, scenario, chosen, slow)


@pytest.fixture(name="autolock", scope="module")
def autolock_fixture(tmp_path_factory):
    """Folder with a recorded Autolock."""
    folder = tmp_path_factory.mktemp("autolock")
    measured(folder, "autolock", AUTOLOCK)
    return folder


def profile(folder, **changes):
    """The demo car's profile with changes; None leaves an entry out."""
    text = (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text().replace(*SLOWER)
    for old, new in changes.values():
        assert old in text
        text = text.replace(old, new)
    path = folder / "mended.yaml"
    path.write_text(text)
    shutil.copy(PROFILE_FOLDER / "mtr_demo_car.dbc", folder)
    return str(path)


def test_replay_of_a_test_gives_the_same_distances(autolock, capsys):
    code, document = replayed(autolock, capsys)
    assert code == 0 and document["is_unchanged"]
    assert document["worst_m"] <= 1e-6
    distances = [each for line in document["lines"] for each in line["distances"]]
    assert len(distances) >= 16 and sum(each["now"]["distance_m"] is not None for each in distances) >= 14


def test_replay_says_in_words_that_nothing_changes(autolock, capsys):
    assert main(["replay", str(autolock / "progress.json")]) == 0
    assert "are as in the record; the largest difference is 0.000 mm" in capsys.readouterr().out


def test_bundle_is_replayed_by_the_profile_that_it_keeps(autolock, capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    bundle = tmp_path / "test.mtr.zip"
    assert main(["bundle", str(autolock), "--out", str(bundle)]) == 0
    (autolock / "mended.yaml").rename(tmp_path / "elsewhere.yaml")
    try:
        code, document = replayed(bundle, capsys)
        assert code == 0 and document["is_unchanged"] and document["worst_m"] <= 1e-6
        zipfile.ZipFile(bundle).extractall(tmp_path / "unpacked")
        assert replayed(tmp_path / "unpacked", capsys)[0] == 0
    finally:
        (tmp_path / "elsewhere.yaml").rename(autolock / "mended.yaml")


def test_bundle_that_is_changed_is_not_replayed(autolock, capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    bundle = tmp_path / "test.mtr.zip"
    assert main(["bundle", str(autolock), "--out", str(bundle)]) == 0
    content = bytearray(bundle.read_bytes())
    content[content.index(b"scenario")] ^= 1
    bundle.write_bytes(content)
    capsys.readouterr()
    assert main(["replay", str(bundle)]) == 2
    told = capsys.readouterr()
    assert "not as it was signed, and nothing is computed from it" in told.err and not told.out


def test_replay_of_nothing_says_so(capsys, tmp_path):
    assert main(["replay", str(tmp_path / "nothing")]) == 2
    assert capsys.readouterr().err.strip() == f"There is no test in {tmp_path / 'nothing'}."


def test_profile_with_another_cycle_moves_the_distances(autolock, capsys, tmp_path):
    told = profile(tmp_path, sent=("sent_on_change: false", "sent_on_change: true"))
    code, document = replayed(autolock, capsys, "--car-profile", told)
    assert code == 3
    # A change is placed at its frame instead of half a cycle before it: 100 ms at up to 1 m/s.
    assert 0.01 < document["worst_m"] < 0.15


def test_profile_that_lists_no_such_cause_makes_the_lines_invalid(autolock, capsys, tmp_path):
    told = profile(tmp_path, cause=("  1: passive_entry", "  3: passive_entry"))
    code, document = replayed(autolock, capsys, "--car-profile", told)
    assert code == 3
    assert {each["now"]["status"] for line in document["lines"] for each in line["distances"]} == {"invalid"}


def test_log_of_another_bus_has_no_reaction_in_it(autolock, capsys, tmp_path):
    other = tmp_path / "other.asc"
    log = BusLog(other)
    for index in range(200):
        log.frame(CanFrame(0x123, False, bytes(8), 0.02 * index), 0.02 * index)
    log.close()
    code, document = replayed(autolock, capsys, "--can-log", str(other))
    notice, = document["notices"]
    assert "tells no state of message DoorLockStatus (id 0x320): it is of another car or bus" in notice
    assert code == 3 and not any(each["now"]["distance_m"] for line in document["lines"] for each in line["distances"])
    assert not document["is_whole"]


def run_of(autolock):
    """Its log's frames."""
    return list(ReadLog(autolock / "recording" / "bus_001.blf"))


def test_log_that_ends_before_the_test_says_nothing_of_the_rest(autolock, capsys, tmp_path):
    short = tmp_path / "short.asc"
    log = BusLog(short)
    frames = run_of(autolock)
    for frame in frames[:len(frames) // 2]:
        log.frame(CanFrame(frame.can_id, frame.is_extended, frame.data, frame.time_s), frame.time_s)
    log.close()
    code, document = replayed(autolock, capsys, "--can-log", str(short))
    assert code == 3 and not document["is_whole"] and not document["is_unchanged"]
    assert f"ends after {len(frames) // 2} frames, before the test does." in document["notices"][0]
    assert main(["replay", str(autolock), "--can-log", str(short)]) == 3
    assert "whether the others are as in the record it does not say." in capsys.readouterr().out


def test_scan_of_key_presses_is_replayed(tmp_path, capsys):
    measured(tmp_path, "key_press", KEY_PRESS)
    code, document = replayed(tmp_path, capsys)
    assert code == 0 and document["worst_m"] <= 1e-6
    assert all(line["distances"][0]["now"]["status"] == "ok" for line in document["lines"])


def test_test_without_a_recording_says_so(tmp_path, capsys, autolock):
    shutil.copy(autolock / "progress.json", tmp_path)
    assert main(["replay", str(tmp_path)]) == 2
    assert "There is no recording of the test" in capsys.readouterr().err


def test_log_is_played_as_the_car(autolock):
    run, = recorded_runs(autolock / "recording")
    car = LogCarLink(run.log, str(autolock / "mended.yaml"))
    car.connect()
    events = []
    for index in range(1, 3000):
        time_s = 50.0 + 0.1 * index
        events += car.observe(RobotStatus(index, 1, time_s, sent_s=time_s, steady_s=time_s))
        if index == 50:
            assert (car.problem, car.lock_state) == ("", LockState.LOCKED)
    states = [event.lock_state for event in events]
    assert len(states) >= 14 and states[0] is LockState.UNLOCKED
    assert all(first is not second for first, second in zip(states, states[1:]))
    assert "has come to its end" in car.problem
    car.close()


def test_course_is_read_as_it_was_written(tmp_path):
    path = tmp_path / "course.jsonl"
    course = CourseFile(path)
    status = RobotStatus(3, 7, 1.25, x=0.1, y=-2.0, heading=0.3, pose_valid=True, key_x=0.25)
    mark = BusMark(5, 6, 1.5, 1.6, 0.5, "KERNEL", 1)
    course.note("too early", {})
    course.status(status, mark)
    course.note("expected", {"state": "locked"})
    course.status(status, None)
    course.close()
    first, note, second = read_course(path)
    assert isinstance(first, Moment) and (first.status.x, first.status.id, first.mark) == (0.1, 3, mark)
    assert first.status.pose_valid and note == Note("expected", {"state": "locked"})
    assert second.mark is None


def test_torn_course_is_read_up_to_there_and_a_damaged_one_is_refused(tmp_path, autolock):
    run, = recorded_runs(autolock / "recording")
    content = run.course.read_bytes()
    path = tmp_path / "course.jsonl"
    path.write_bytes(content[:len(content) // 2])
    assert 0 < len(list(read_course(path))) < content.count(b"\n")
    path.write_bytes(content[:200] + b"\n{}\n" + content[200:])
    with pytest.raises(ProgressFileError, match="damaged in line"):
        list(read_course(path))


def test_disk_that_is_full_ends_the_course_and_no_test(tmp_path):
    (tmp_path / "file").write_text("")
    course = CourseFile(tmp_path / "file" / "course.jsonl")
    course.status(RobotStatus(1, 1, 1.0), None)
    assert "is not kept" in course.problem
    course.status(RobotStatus(2, 1, 1.1), None)
    course.close()


def test_run_that_measured_nothing_leaves_no_recording(tmp_path):
    with can.Bus(interface="virtual", channel="nothing"):
        spoken = SpokenCar(FakeRobotLink(1), "nothing")
        spoken.connect()
        spoken.car.connect()
        recording = Recording(tmp_path / "progress.json")
        course = recording.begin(spoken.car)
        status = spoken.next_status(1.0)
        spoken.car.observe(status)
        course.status(status, spoken.car.mark)
        recording.event(EventEntry(now(), None, EventKind.TEST, INFO, "application", "The test begins."))
        # Of bus, course, scans and event list.
        assert list(recording.end()) == ["", "", "", ""]
        assert len(list((tmp_path / "recording").iterdir())) == 3
        recording.discard()
        spoken.car.close()
        spoken.close()
    assert list(pathlib.Path(tmp_path).iterdir()) == []


TWO_BUSES = """BO_ 1281 CAUSE: 12 Body
 SG_ BY : 0|4@1+ (1,0) [0|15] "" Body
"""


@pytest.mark.parametrize(("log_format", "length"), [("blf", 12), ("asc", 12), ("trc", 8), ("asc", 8), ("blf", 8)])
def test_replay_of_two_buses_gives_the_same_distances_from_each_format(tmp_path, capsys, log_format, length):
    path = pathlib.Path(profile(tmp_path))
    (tmp_path / "body.dbc").write_text('VERSION ""\nBU_: Body\n' + TWO_BUSES.replace("12 Body", f"{length} Body"))
    begin, _, _ = path.read_text().replace("source_signal: LastCommandSource", "buses: {body: body.dbc}\ncauses:") \
        .partition("sources:")
    path.write_text(f"{begin}  - {{bus: body, message: CAUSE, signal: BY, sources: {{1: passive_entry}}}}")
    scenario = SCENARIOS["autolock"]
    chosen = scenario.parameters_type.from_mapping({**scenario.parameters_type.proposed(), **AUTOLOCK})
    progress = recorded(tmp_path, scenario, chosen, str(path), log_format)
    assert {result.unlock_cause for result in progress.results} == {"passive_entry"}
    code, document = replayed(tmp_path, capsys)
    assert code == 0 and document["is_unchanged"] and document["notices"] == []


@pytest.fixture(name="played", scope="module")
def played_fixture(tmp_path_factory):
    """Folder of a test that played a log, of the log and of the profile, which the record names relatively."""
    folder = tmp_path_factory.mktemp("played")
    path, message, now_s = folder / "bus.log", DemoLockMessage(), 0.0
    with path.open("w") as log:
        for index in range(12_000):
            message.is_locked = index // 60 % 2 == 0
            now_s += 0.2
            log.write(f"({1.7e9 + now_s:.6f}) can0 320#{message.next().hex()}\n")
    parameters = folder / "autolock.yaml"
    parameters.write_text("\n".join(f"{name}: {str(value).lower()}" for name, value in AUTOLOCK.items()))
    profile(folder)
    with contextlib.chdir(folder):
        main(["run", "autolock", "--params", "autolock.yaml", "--out", "test", "--simulated-robot", "--can-log",
              "bus.log", "--car-profile", "mended.yaml"])
    return folder


def test_test_that_played_a_log_is_replayed_with_it_from_any_folder(played, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, document = replayed(played / "test", capsys, "--can-log", str(played / "bus.log"))
    assert document["is_unchanged"] and code == 0
    assert document["measurements"] > 0


def test_test_that_played_a_log_asks_for_it(played, capsys):
    assert main(["replay", str(played / "test")]) == 2
    assert "The test played the CAN log bus.log, which is not kept with it; name that log" in capsys.readouterr().err


def test_profile_that_a_record_names_relatively_is_missed_with_a_sentence(played, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copytree(played / "test", tmp_path / "elsewhere" / "test")
    # Of an older test no profile was kept.
    shutil.rmtree(tmp_path / "elsewhere" / "test" / "recording" / "car")
    assert main(["replay", str(tmp_path / "elsewhere" / "test"), "--can-log", str(played / "bus.log")]) == 2
    assert "names its car profile as mended.yaml, which is neither in this folder nor above" in capsys.readouterr().err


def test_log_beside_a_test_without_one_has_no_times_of_the_test(played, capsys, tmp_path):
    folder = tmp_path / "test"
    shutil.copytree(played / "test", folder)
    profile(tmp_path)
    (folder / "progress.journal").unlink()
    record = folder / "progress.json"
    record.write_text(record.read_text().replace("none: the log bus.log was played", "slcan, 500000 bit/s"))
    assert main(["replay", str(folder), "--can-log", str(played / "bus.log")]) == 2
    assert "its times cannot be brought together with the test's" in capsys.readouterr().err
