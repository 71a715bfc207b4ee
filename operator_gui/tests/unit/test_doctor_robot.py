"""Looking at a robot: findings in sentences, an exit code that says whether a test could begin, and nothing is sent."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import time

import pytest

from mtr_operator.cli import main
from mtr_operator.doctor import robot_command_line
from mtr_operator.doctor.robot import Heard, listen, robot_items, robot_sentences
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import EmergencyStop, Mode, Notification, PreflightItem, PreflightReport
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.conversions import decode_command
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_operator.robot_link.virtual.robot import VirtualRobot, VirtualWorld
from mtr_operator.station.checks.checklist import hindrances
from mtr_operator.station.checks.finding import Check, State
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Mailbox

STARTED = VirtualWorld(starting_s=0.0)
# 26 November 2026.
NOW_S = 1_795_651_200.0
# What was sent before is there by then.
DRAIN_MS = 100


class Listening(ConnectionServer):
    """Keeps what is sent to the robot."""

    def __init__(self):
        super().__init__()
        self._commands, self.robot = [], None

    @property
    def command_socket(self):
        """See ConnectionServer; what is received through it is kept."""
        return Kept(super().command_socket, self._commands)

    def senders(self):
        """Ends the robot; the sessions of all that was ever sent to it."""
        self.robot.stop()
        while super().command_socket.poll(DRAIN_MS):
            self._commands.append(super().command_socket.recv_multipart())
        return {decode_command(parts[0]).session_id for parts in self._commands}


class Kept:
    """A socket whose messages are kept."""

    def __init__(self, socket, messages):
        self._socket, self._messages = socket, messages

    def __getattr__(self, name):
        return getattr(self._socket, name)

    def recv_multipart(self, flags):
        """See zmq.Socket."""
        self._messages.append(self._socket.recv_multipart(flags))
        return self._messages[-1]


@pytest.fixture(name="server")
def server_fixture(monkeypatch):
    """A virtual robot that has started, behind its ports."""
    monkeypatch.setattr(robot_command_line, "LISTEN_S", 0.5)
    with Listening() as server:
        server.robot = RobotSubstitute(server, world=STARTED)
        server.robot.start()
        yield server
        server.robot.stop()


def look(server, *extra):
    return main(["doctor", "--robot", "127.0.0.1", "--subscriber-port", str(server.subscriber_port),
                 "--publisher-port", str(server.publisher_port), *extra])


def test_robot_that_is_ready_is_told_of_and_nothing_is_sent(server, capsys):
    assert look(server) == 0
    told = capsys.readouterr().out
    for part in ("ok      Link: ", "ok      Encryption: Not encrypted; it does not leave this computer.",
                 "ok      Round trip: A round trip takes ", " 0 were lost", "ok      State: The robot says: ready to",
                 "ok      Control: No application controls the robot.", "ok      Battery: At 80 %",
                 "unknown Preflight: Never made since the robot was started.", "ok      Software: The robot runs ",
                 "unknown Robot's clock: The robot tells simulated time.",
                 "A test could begin, as far as the robot is concerned; nothing was sent to it."):
        assert part in told, told
    assert "CAN bus" not in told and "Disk" not in told
    assert server.senders() == set()


def test_look_takes_the_robot_from_nobody_and_names_who_has_it(server, capsys):
    driver = ZmqRobotLink("127.0.0.1", server.subscriber_port, server.publisher_port)
    driver.connect()
    until = time.monotonic() + 5.0
    while time.monotonic() < until and driver.next_status(1.0).session_id != driver.session_id:
        driver.send(DesiredState())
    assert look(server) == 1
    told = capsys.readouterr().out
    assert "bad     Robot: Another application controls the robot. End the other application; control comes" in told
    assert "note    Control: The robot obeys an application." in told
    assert told.endswith("No test could begin before what is bad is mended; nothing was sent to the robot.\n")
    assert server.senders() == {driver.session_id}
    driver.close()


def test_application_that_was_killed_hinders_no_other():
    lost = Notification("link_lost", 3, "The application is silent.")
    link = Told(controlled_by_other=True, controller_name="Jana", notifications=(lost,))
    found = listen(link, 1.0, iter([0.0, 0.0, 0.1, 1.1, 1.1]).__next__)
    assert not hindrances(robot_items(found))
    assert said(found)["Control"] == (State.NOTE, "The robot waits for an application with the key of Jana that fell "
                                                  "silent; the next one takes over.")
    assert hindrances(robot_items(dataclasses.replace(found, is_abandoned=False)))


class Told(FakeRobotLink):
    """A robot that has started, each of whose Statuses is changed like that."""

    def __init__(self, **changes):
        super().__init__(world=STARTED)
        self._changes = changes
        self.connect()

    def next_status(self, timeout_s):
        return dataclasses.replace(super().next_status(timeout_s), **self._changes)


def test_robot_that_is_not_there_is_one_sentence(capsys):
    with ConnectionServer() as gone:
        pass
    assert look(gone) == 1
    assert "bad     Link: Nothing listens on subscriber port" in capsys.readouterr().out


def test_address_that_cannot_be_right_is_an_error(capsys):
    assert main(["doctor", "--robot", "300.1.1.1"]) == 2
    assert "300.1.1.1" in capsys.readouterr().err


def heard(longest_gap_s=0.11, clock=lambda: NOW_S, **changes):
    virtual = VirtualRobot(1, STARTED)
    virtual.step()
    status = dataclasses.replace(virtual.status(), **changes)
    mailbox = Mailbox(wall_clock=clock)
    mailbox.put_robot(RobotSnapshot(status, LockState.UNKNOWN, "No adapter.", is_secret=True))
    return Heard(mailbox.take().robot, 0.05, longest_gap_s, 30, 0)


def said(robot, round_trip_s=0.002):
    return {each.what: (each.state, each.sentence) for each in robot_sentences(robot, round_trip_s)}


@pytest.mark.parametrize(("changes", "what", "state", "part"), [
    ({"sent_s": NOW_S - 3600.0, "steady_s": 5.0}, "Robot's clock", State.NOTE, "1 h 0 min behind this laptop's"),
    ({"battery_percent": 5}, "Battery", State.BAD, "Nearly empty: 5 %. Charge it before the test."),
    ({"mode": Mode.FAULT, "notifications": (Notification("fault", 3, "The lift is stuck."),)}, "Robot", State.BAD,
     "The lift is stuck. Make sure that nothing blocks the robot"),
    ({"controlled_by_other": True, "controller_name": "Jana"}, "Control", State.NOTE, "with the key of Jana."),
    ({"steady_s": math.nan, "emergency_stop": EmergencyStop.UNKNOWN}, "Software", State.NOTE,
     "does not tell its steady clock, its emergency stop: upgrade it."),
    ({"longest_gap_s": 0.6}, "Round trip", State.NOTE, "bring laptop and robot nearer"),
    ({}, "Encryption", State.GOOD, "The link to the robot is encrypted.")])
def test_each_finding_says_what_to_do(changes, what, state, part):
    found, sentence = said(heard(**changes))[what]
    assert found is state and part in sentence


def test_all_that_preflight_found_wrong_is_told():
    items = (PreflightItem("disk", True, "Full."), PreflightItem("/imu/data", True, "Silent."),
             PreflightItem("battery", False, "Fine."))
    told = [each.sentence for each in robot_sentences(heard(preflight=PreflightReport(1.0, items, 3, 2)), math.nan)
            if each.what == "Preflight"]
    assert [sentence for sentence in told if "Fine" in sentence] == []
    assert "disk: Full." in told[0] and told[1:] == ["/imu/data: Silent."]


def test_connected_robot_that_says_nothing_hinders():
    found = robot_items(Heard(None, 3.0, 3.0, 0, 0))
    assert [(item.check, item.state) for item in found] == [(Check.LINK, State.BAD)]


def test_time_between_two_statuses_is_measured():
    times = iter([0.0, 0.0, 0.2, 0.2, 0.9, 0.9, 1.0, 5.0, 5.0])
    found = listen(Told(), 3.0, times.__next__)
    assert (found.count, found.longest_gap_s, found.silent_s) == (3, 4.0, 4.0)
