"""The event list: what robot, Car and test say, once each, and kept with the test."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import datetime

import pytest

from mtr_operator.domain.actions.event_observer import EventObserver, run_told
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import LinkLost, ProgressFileError
from mtr_operator.domain.eventlog.entry import ERROR, INFO, WARNING, EventEntry, EventKind
from mtr_operator.domain.eventlog.event_list import MAX_KEPT, EventList, event_filter
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.robot_status import (
    CarCheck,
    CarDimensions,
    CarFrame,
    CheckState,
    EmergencyStop,
    Interventions,
    LogMessage,
    Mode,
    Notification,
    PressReport,
    RobotStatus,
    WaypointResult,
)
from mtr_operator.storage.recorded import event_file
from mtr_operator.storage.recorded.event_file import EventFile, read_events

NOON = datetime.datetime(2026, 11, 23, 12, tzinfo=datetime.timezone.utc)
CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)
QUIET = RobotStatus(1, 7, 100.0, mode=Mode.FOLLOWING_WAYPOINT, car=CAR, emergency_stop=EmergencyStop.RELEASED,
                    session_id=3, car_check=CarCheck())


class Listener:
    """Attributes: entries: what was told."""

    def __init__(self):
        self.entries, self.time = [], NOON
        self.log = EventLog(lambda: self.time)
        self.log.listen(self.entries.append)

    def hear(self, *statuses, **arguments):
        """Texts that these Statuses make."""
        self.entries.clear()
        for status in statuses:
            self.log.learn(status, **arguments)
        return [entry.text for entry in self.entries]


@pytest.fixture(name="listener")
def listener_of_a_quiet_robot():
    made = Listener()
    made.hear(QUIET)
    return made


def with_log(*ids, session=7):
    return dataclasses.replace(QUIET, robot_session_id=session, log=tuple(
        LogMessage(number, 99.0 + number, 2, "lift", f"Sentence  {number}.") for number in ids))


def test_sentence_of_the_log_that_comes_in_several_statuses_is_told_once(listener):
    assert listener.hear(with_log(1), with_log(1, 2), with_log(2)) == ["Sentence 1.", "Sentence 2."]
    entry = listener.entries[0]
    assert (entry.kind, entry.source, entry.severity, entry.robot_time_s, entry.time) == (
        EventKind.ROBOT_LOG, "lift", WARNING, 100.0, NOON)


def test_log_of_a_robot_that_started_anew_begins_anew(listener):
    listener.hear(with_log(1, 2))
    assert listener.hear(with_log(1, session=8)) == ["The robot has started anew.", "Sentence 1."]


def test_notice_is_told_when_it_begins_and_ends_and_not_when_its_figures_change(listener):
    def near(distance_m):
        return dataclasses.replace(QUIET, notifications=(
            Notification("obstacle", 2, f"Something is {distance_m} m ahead."),))
    assert listener.hear(near(0.6), near(0.5), QUIET) == ["Something is 0.6 m ahead.",
                                                         "Over: Something is 0.5 m ahead."]
    assert [entry.severity for entry in listener.entries] == [WARNING, INFO]


@pytest.mark.parametrize(("changed", "text", "severity"), [
    ({"mode": Mode.FAULT}, "The robot has a fault.", ERROR),
    ({"mode": Mode.MAPPING_CAR}, "The robot maps the Car.", INFO),
    ({"waypoint_id": 4, "waypoint_result": WaypointResult.REACHED}, "Waypoint 4 is reached.", INFO),
    ({"waypoint_id": 4, "waypoint_result": WaypointResult.REFUSED, "waypoint_message": "It is too far."},
     "It is too far.", ERROR),
    ({"waypoint_id": 4, "waypoint_result": WaypointResult.BLOCKED}, "Something stands in the robot's way.", WARNING),
    ({"presses": (PressReport(1, 100.0, 100.3),)}, "The button was pressed for 0.30 s.", INFO),
    ({"presses": (PressReport(1, 0.0, 0.0, "The lift moves."),)}, "The lift moves.", ERROR),
    ({"car_check": CarCheck(1, CheckState.FAILED)}, "The Car does not stand where it was measured.", ERROR),
    ({"car_check": CarCheck(1, CheckState.PASSED)}, "The Car stands where it was measured.", INFO),
    ({"car_frame": CarFrame(2, 0.03, 0.04, 0.0)},
     "The Car coordinate system was corrected by 5.0 cm and 0.00 degrees.", WARNING),
    ({"interventions": Interventions(manual_drives=1)}, "The robot was driven by hand.", WARNING),
    ({"emergency_stop": EmergencyStop.ENGAGED}, "The emergency stop is pressed.", ERROR)])
def test_change_of_the_robot_is_told_once(listener, changed, text, severity):
    status = dataclasses.replace(QUIET, **changed)
    assert listener.hear(status, status) == [text]
    assert listener.entries[0].severity == severity


def test_press_of_another_session_with_the_same_number_is_another_one(listener):
    def pressed(session):
        return dataclasses.replace(QUIET, session_id=session, presses=(PressReport(1, 100.0, 100.3),))
    assert len(listener.hear(pressed(3), pressed(4), pressed(4))) == 2


def test_another_application_is_told_once_it_stays_and_not_at_the_change_of_our_own_sessions(listener):
    def other(stamp_s):
        return dataclasses.replace(QUIET, stamp_s=stamp_s, controlled_by_other=True)
    assert listener.hear(other(100.0), other(100.1), QUIET, other(101.0), other(101.1), QUIET) == []
    assert listener.hear(other(102.0), other(103.0), other(104.0), QUIET) == [
        "Another application controls the robot.", "No other application controls the robot any more."]


def test_way_that_is_free_again_and_a_car_that_is_found_are_told(listener):
    blocked, free = (dataclasses.replace(QUIET, waypoint_id=4, waypoint_result=result)
                     for result in (WaypointResult.BLOCKED, WaypointResult.PENDING))
    assert listener.hear(blocked, free)[1:] == ["The robot's way is free again."]
    assert listener.hear(dataclasses.replace(QUIET, car=None), QUIET) == ["The Car is found: 4.50 m long, 1.80 m wide."]


def test_change_of_the_locks_has_the_time_of_the_event_its_cause_and_its_doubt(listener):
    event = CarEvent(99.5, 0.01, LockState.UNLOCKED, "key_button", "Two answers came.")
    assert listener.hear(QUIET, events=[event]) == ["The Car is unlocked now (the key's button).", "Two answers came."]
    assert {(entry.kind, entry.robot_time_s) for entry in listener.entries} == {(EventKind.LOCKS, 99.5)}


def test_trouble_of_the_bus_is_told_when_it_begins_and_ends(listener):
    assert listener.hear(QUIET, problem="No CAN frame for 0.6 s.") == ["No CAN frame for 0.6 s."]
    assert listener.hear(QUIET, problem="No CAN frame for 0.7 s.") == []
    assert listener.hear(QUIET) == ["Over: No CAN frame for 0.7 s."]


def test_silence_is_told_once_and_how_long_it_was(listener):
    listener.entries.clear()
    listener.log.silent()
    listener.log.silent()
    listener.time += datetime.timedelta(seconds=4.2)
    listener.log.learn(QUIET)
    assert [entry.text for entry in listener.entries] == ["The robot is not heard any more.",
                                                         "The robot is heard again after 4.2 s."]


def test_run_tells_actions_results_and_its_end(listener):
    listener.entries.clear()
    observer = EventObserver(RunObserver(), listener.log, "axis")
    with pytest.raises(Cancelled), run_told(listener.log, False):
        observer.on_action("axis 1 (front): go to the start")
        observer.on_action("axis 1 (front): go to the start")
        raise Cancelled("x")
    with pytest.raises(LinkLost), run_told(listener.log, True):
        raise LinkLost("Silent.")
    with run_told(listener.log, True):
        pass
    assert [entry.text for entry in listener.entries] == [
        "The test begins.", "axis 1 (front): go to the start", "The test is paused.", "The test goes on.", "Silent.",
        "The test goes on.", "All lines are measured."]


def entry(number=0, kind=EventKind.FAULT, severity=WARNING, text="The lift, \"slow\"."):
    return EventEntry(NOON, 12.345, kind, severity, f"node{number}", text)


def test_file_holds_each_entry_at_once_and_is_read_back(tmp_path):
    file = EventFile(tmp_path / "recording" / "events_001.csv")
    entries = [entry(), dataclasses.replace(entry(1), robot_time_s=None, text="two\nrows")]
    for each in entries:
        file.add(each)
    # Before it is closed: an application that is killed loses nothing.
    found = list(read_events(file.path))
    file.close()
    assert found == [entries[0], dataclasses.replace(entries[1], text="two rows")]
    assert file.path.read_bytes().startswith(b"time,robot_time_s,kind,severity,source,text\r\n")


@pytest.mark.parametrize("content", ["", "other,columns\n1,2\n", "time,robot_time_s,kind,severity,source,text\n"
                                     "yesterday,,fault,info,a,b\n", "time,robot_time_s,kind,severity,source,text\n"
                                     "2026-11-23T12:00:00.000+00:00,,fault,loud,a,b\n"])
def test_damaged_file_is_one_sentence(tmp_path, content):
    path = tmp_path / "events_001.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ProgressFileError, match="damaged in line"):
        list(read_events(path))


def test_entry_that_was_cut_off_is_left_out(tmp_path):
    path = tmp_path / "events_001.csv"
    with_one = EventFile(path)
    with_one.add(entry())
    with_one.close()
    with open(path, "a", encoding="utf-8") as file:
        file.write("2026-11-23T12:00:00.000+00:00,,fau")
    assert list(read_events(path)) == [entry()]


def test_full_disk_ends_the_file_with_a_sentence_and_no_test(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("no folder", encoding="utf-8")
    full = EventFile(tmp_path / "file" / "events_001.csv")
    full.add(entry())
    full.add(entry())
    full.close()
    assert full.problem.startswith("The event list is not kept in")
    monkeypatch.setattr(event_file, "MAX_ENTRIES", 2)
    flooded = EventFile(tmp_path / "events_002.csv")
    for number in range(4):
        flooded.add(entry(number))
    flooded.close()
    assert len(list(read_events(flooded.path))) == 2 and "holds 2 entries" in flooded.problem


def test_list_is_bounded_and_tells_what_came_since():
    events = EventList()
    for number in range(MAX_KEPT + 5):
        events.add(entry(number))
    assert len(events.entries) == MAX_KEPT and events.count == MAX_KEPT + 5
    assert [each.source for each in events.since(MAX_KEPT + 3)] == [f"node{MAX_KEPT + 3}", f"node{MAX_KEPT + 4}"]
    assert len(events.since(0)) == MAX_KEPT


@pytest.mark.parametrize(("kind", "severity", "searched", "taken"), [
    (None, INFO, "", True), (EventKind.FAULT, WARNING, "node0 LIFT", True), (EventKind.LOCKS, INFO, "", False),
    (None, ERROR, "", False), (None, INFO, "lift wheel", False), (None, INFO, "zdvih", True)])
def test_filter_takes_kind_severity_and_all_words(kind, severity, searched, taken):
    assert event_filter(kind, severity, searched).takes(entry(), "Pomalý zdvih.") is taken
