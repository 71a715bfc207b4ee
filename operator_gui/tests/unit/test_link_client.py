"""The link's behaviour on the wire, against a server that sends what the test says."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from dataclasses import replace

import pytest

from mtr_operator.domain.errors import ConnectionFailed, LinkLost
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Waypoint
from mtr_operator.domain.robot_status import CarCheck, CheckState, PressReport, RobotStatus, WaypointResult
from mtr_operator.robot_link.client import MAX_FREE_STATUSES, ZmqRobotLink
from mtr_operator.robot_link.conversions import decode_command, status_message_from
from mtr_operator.robot_link.inbox import MAX_BACKLOG
from mtr_operator.robot_link.server import ConnectionServer

WAIT_S = 5.0
GO = DesiredState(waypoint=Waypoint(1, Pose(2.0, 0.0, 0.0)))


class Robot:
    """Server side of one connected link; command_id is that of its first Command."""

    def __init__(self, server, link):
        self.server, self.link, self.command_id = server, link, 0

    def send(self, status_id, robot_session_id=1):
        """Send a Status."""
        self.send_status(RobotStatus(status_id, robot_session_id, status_id / 10))

    def send_status(self, status):
        """Send this Status."""
        self.send_bytes(status_message_from(status).SerializeToString())

    def send_bytes(self, *parts):
        """Send anything."""
        self.server.status_socket.send_multipart(parts)

    def take(self):
        """Next Status at the link."""
        status = self.link.next_status(WAIT_S)
        assert status is not None
        return status

    def command(self):
        """Next Command at the robot."""
        assert self.server.command_socket.poll(WAIT_S * 1000)
        return decode_command(self.server.command_socket.recv())

    def has_command(self):
        """A Command is waiting."""
        return bool(self.server.command_socket.poll(50))


@pytest.fixture(name="robot")
def robot_fixture():
    """Connected pair on which both subscriptions have come into force, after Status 1."""
    with ConnectionServer() as server:
        link = ZmqRobotLink("127.0.0.1", server.subscriber_port, server.publisher_port)
        link.connect()
        robot = Robot(server, link)
        deadline = time.monotonic() + WAIT_S
        while link.next_status(0.01) is None:
            assert time.monotonic() < deadline
            robot.send(1)
        while not server.command_socket.poll(10):
            assert time.monotonic() < deadline
            link.send(DesiredState())
        while server.command_socket.poll(50):
            robot.command_id = decode_command(server.command_socket.recv()).id
        yield robot
        link.close()


def test_statuses_come_in_order_and_losses_are_counted(robot):
    for status_id in (2, 3, 6):
        robot.send(status_id)
    assert [robot.take().id for _ in range(3)] == [2, 3, 6]
    assert robot.link.statistics.lost == 2


def test_no_status_in_time_is_none(robot):
    assert robot.link.next_status(0.01) is None


def test_command_answers_the_status_that_was_taken(robot):
    robot.send(2)
    robot.send(3)
    robot.take()
    before = time.monotonic()
    robot.link.send(GO)
    command = robot.command()
    assert (command.session_id, command.seen_status_id, command.seen_robot_time_s) == (robot.link.session_id, 2, 0.2)
    assert before <= command.sent_time_s <= time.monotonic()


def test_id_grows_with_each_change_of_the_content_only(robot):
    for desired in (GO, GO, DesiredState(stop=True), GO):
        robot.link.send(desired)
    first, second, third, fourth = (robot.command().id for _ in range(4))
    assert first == second < third < fourth


def test_repeated_status_is_answered_again_but_not_returned(robot):
    robot.send(2)
    robot.take()
    robot.link.send(GO)
    answer = robot.command()
    robot.send(2)
    assert robot.link.next_status(0.2) is None
    again = robot.command()
    assert (again.id, again.seen_status_id, again.waypoint.id) == (answer.id, 2, 1)


def test_repeated_status_without_an_answer_yet_stays_unanswered(robot):
    robot.send(2)
    robot.take()
    robot.send(2)
    assert robot.link.next_status(0.2) is None
    assert not robot.has_command()


def test_garbage_is_counted_and_ignored(robot):
    robot.send_bytes(b"\xff" * 10)
    robot.send_bytes(b"a", b"b")
    robot.send_bytes(b"")
    robot.send(2)
    assert robot.take().id == 2
    assert robot.link.statistics.undecodable == 3
    assert "ignored" in robot.link.statistics.last_error


def test_oversized_message_is_counted_and_ignored(robot):
    robot.send_bytes(b"x" * (64 * 1024 + 1))
    robot.send(2)
    assert robot.take().id == 2
    assert robot.link.statistics.oversized == 1


def test_restarted_robot_is_noticed_and_gets_the_order_again(robot):
    robot.send(2)
    robot.take()
    robot.link.send(GO)
    robot.command()
    robot.send(1, robot_session_id=99)
    status = robot.take()
    assert [notification.code for notification in status.notifications] == ["robot_restarted"]
    assert "restarted" in robot.link.statistics.last_error
    robot.link.send(GO)
    assert robot.command().waypoint.id == 1


def test_old_backlog_is_skipped_to_the_newest(robot):
    newest = MAX_BACKLOG + 2
    for status_id in range(2, newest + 1):
        robot.send(status_id)
    # The last one arrives after all others: same connection.
    deadline = time.monotonic() + WAIT_S
    while robot.link._sockets.subscriber.poll(100) and robot.link._inbox._newest_id < newest:
        robot.link._receive_waiting(robot.link._sockets.subscriber)
        assert time.monotonic() < deadline
    assert robot.take().id == newest
    assert robot.link.statistics.lost == MAX_BACKLOG


def test_goodbye_gets_out_when_closing(robot):
    robot.link.close()
    command = robot.command()
    assert command.end_session and command.stop and not command.HasField("waypoint")
    robot.link.close()


def test_each_link_has_a_session_of_its_own():
    sessions = {ZmqRobotLink("127.0.0.1").session_id for _ in range(20)}
    assert len(sessions) == 20
    assert all(0 < session < 2 ** 63 for session in sessions)


def test_confirmations_of_another_session_are_not_taken_for_ours(robot):
    foreign = RobotStatus(2, 1, 0.2, session_id=robot.link.session_id + 1, command_id=3, waypoint_id=1,
                          waypoint_result=WaypointResult.REACHED, presses=(PressReport(1, 0.1, 0.15),))
    robot.send_status(foreign)
    status = robot.take()
    assert status.controlled_by_other
    assert (status.waypoint_id, status.waypoint_result, status.presses) == (0, WaypointResult.NONE, ())
    robot.send_status(replace(foreign, id=3, session_id=robot.link.session_id))
    status = robot.take()
    assert not status.controlled_by_other
    assert (status.waypoint_id, status.waypoint_result) == (1, WaypointResult.REACHED)


def test_confirmations_of_another_session_are_all_taken_away(robot):
    robot.send_status(RobotStatus(
        2, 1, 0.2, session_id=robot.link.session_id + 1, command_id=3, map_car_id=4, waypoint_message="Blocked.",
        car_check=CarCheck(5, CheckState.PASSED)))
    status = robot.take()
    assert (status.command_id, status.map_car_id, status.waypoint_message) == (0, 0, "")
    assert status.car_check == CarCheck()


def test_a_robot_that_knows_no_check_of_the_car_has_none_in_another_session_either(robot):
    robot.send_status(RobotStatus(2, 1, 0.2, session_id=robot.link.session_id + 1))
    assert robot.take().car_check is None


def test_a_status_without_a_session_is_nobody_elses(robot):
    robot.send(2)
    assert not robot.take().controlled_by_other


@pytest.mark.parametrize("drawn, session_id", [(0, 1), (2 ** 63 - 2, 2 ** 63 - 1)])
def test_every_session_id_but_zero_of_63_bits_is_drawn(monkeypatch, drawn, session_id):
    monkeypatch.setattr("secrets.randbelow", lambda below: drawn if drawn < below <= 2 ** 63 - 1 else None)
    assert ZmqRobotLink("127.0.0.1").session_id == session_id


def test_ids_of_the_commands_count_from_one_to_the_goodbye(robot):
    first = robot.command_id
    robot.link.send(GO)
    robot.link.close()
    assert first == 1
    assert [robot.command().id, robot.command().id] == [2, 3]


def test_only_the_last_command_ends_the_session(robot):
    robot.link.send(GO)
    assert not robot.command().end_session


def test_waiting_status_is_taken_without_any_time_to_wait(robot):
    robot.send(2)
    assert robot.link._sockets.subscriber.poll(WAIT_S * 1000)
    assert robot.link.next_status(0.0).id == 2


def test_nothing_is_waited_for_without_time(robot):
    begun = time.monotonic()
    assert robot.link.next_status(0.0) is None
    assert time.monotonic() - begun < WAIT_S


def test_waiting_ends_with_its_time(robot):
    begun = time.monotonic()
    assert robot.link.next_status(0.3) is None
    assert 0.3 <= time.monotonic() - begun < WAIT_S


def test_status_that_comes_late_in_the_time_is_waited_for(robot):
    sending = threading.Timer(0.2, robot.send, (2,))
    sending.start()
    assert robot.take().id == 2
    sending.join()


def test_a_link_without_a_connection_says_so():
    link = ZmqRobotLink("127.0.0.1")
    with pytest.raises(ConnectionFailed):
        link.next_status(0.0)
    with pytest.raises(ConnectionFailed):
        link.send(GO)


def test_command_answers_with_the_time_of_sending_and_not_of_the_pose(robot):
    robot.send_status(RobotStatus(2, 1, 0.15, pose_valid=True, x=1.0, y=1.0, heading=0.0, sent_s=0.2))
    robot.take()
    robot.link.send(GO)
    assert robot.command().seen_robot_time_s == 0.2


def test_application_goes_on_where_somebody_has_sent_in_its_name(robot):  # D3
    robot.link.send(GO)
    before = robot.command().id
    robot.send_status(RobotStatus(2, 1, 0.2, session_id=robot.link.session_id, command_id=before + 900))
    robot.take()
    robot.link.send(GO)
    assert robot.command().id == before + 901


def test_application_whose_session_the_robot_takes_for_ended_says_so_instead_of_waiting(robot):  # D3
    robot.send_status(RobotStatus(2, 1, 0.2, session_id=robot.link.session_id))
    robot.take()
    for status_id in range(3, 3 + MAX_FREE_STATUSES):
        robot.send(status_id)
        robot.take()
    robot.send(3 + MAX_FREE_STATUSES)
    with pytest.raises(LinkLost, match="no longer takes this application's Commands"):
        robot.take()
