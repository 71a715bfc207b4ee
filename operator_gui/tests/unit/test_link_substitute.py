"""The robot's substitute behind the real link, and the in-process fake."""
# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import sys

import pytest

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Press, Waypoint
from mtr_operator.domain.robot_status import Mode, WaypointResult
from mtr_operator.robot_link import substitute
from mtr_operator.robot_link.checks import HeightCheck, reach_and_hold_height
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_proto import robot_link_pb2 as pb

TIME_FACTOR = 20.0
HEIGHTS_M = (0.7, 1.024, 1.5, 0.35)


@pytest.fixture(scope="module", name="link")
def link_fixture():
    """One link for all tests, as one Operator would have it."""
    with ConnectionServer() as server:
        robot = RobotSubstitute(server, seed=1, time_factor=TIME_FACTOR)
        robot.start()
        link = ZmqRobotLink("127.0.0.1", server.subscriber_port, server.publisher_port)
        link.connect()
        yield link
        link.close()
        robot.stop()


@pytest.fixture(name="fake")
def fake_fixture():
    """Connected fake."""
    link = FakeRobotLink(seed=1)
    link.connect()
    return link


def run_until(link, desired, condition, limit=3000):
    """First Status that meets the condition while each is answered with the desired state."""
    for _ in range(limit):
        status = link.next_status(2.0)
        assert status is not None
        link.send(desired)
        if condition(status):
            return status
    return pytest.fail("condition not met")


@pytest.mark.parametrize("height_m", HEIGHTS_M)
def test_key_height_is_reached_and_held_by_the_substitute(link, height_m):
    assert reach_and_hold_height(link, HeightCheck(height_m)) == ""


@pytest.mark.parametrize("height_m", HEIGHTS_M)
def test_key_height_is_reached_and_held_by_the_fake(fake, height_m):
    assert reach_and_hold_height(fake, HeightCheck(height_m)) == ""


def test_a_height_out_of_reach_fails_the_check(fake):
    assert "3 m not reached" in reach_and_hold_height(fake, HeightCheck(3.0))


def test_waypoint_over_the_wire_is_mapped_for_and_reached(link):
    desired = DesiredState(waypoint=Waypoint(1, Pose(-4.0, 0.5, 0.0)), max_speed_mps=1.0)
    status = run_until(link, desired, lambda s: s.waypoint_id == 1 and s.waypoint_result is WaypointResult.REACHED)
    assert (status.x, status.y, status.heading) == pytest.approx((-4.0, 0.5, 0.0), abs=1e-6)
    assert status.session_id == link.session_id and status.car is not None and status.pose_valid


def test_press_over_the_wire_happens_once_and_is_confirmed(link):
    desired = DesiredState(press=Press(1, (2,), 0.8, 0.5))
    status = run_until(link, desired, lambda s: s.presses)
    run_until(link, desired, lambda s: s.stamp_s > status.stamp_s + 2.0)
    confirmation, = run_until(link, DesiredState(), lambda s: True).presses
    assert (confirmation.id, confirmation.error) == (1, "")
    assert confirmation.end_s - confirmation.start_s == pytest.approx(0.5)


def test_second_session_waits_until_the_first_has_gone(link):
    with_second = ZmqRobotLink("127.0.0.1", link.address.subscriber_port, link.address.publisher_port)
    with_second.connect()
    try:
        before = run_until(link, DesiredState(), lambda s: s.session_id == link.session_id).rejected_messages
        for _ in range(20):
            with_second.send(DesiredState())
            status = run_until(link, DesiredState(), lambda s: True)
        assert status.session_id == link.session_id
        assert status.rejected_messages > before
    finally:
        with_second.close()


def test_time_in_which_the_substitute_was_held_up_is_no_silence_of_the_session(monkeypatch):
    def command(session_id):
        return [pb.Command(id=1, session_id=session_id).SerializeToString()]

    now = [100.0]
    monkeypatch.setattr(substitute.time, "monotonic", lambda: now[0])
    robot = RobotSubstitute(None, seed=1)
    robot._take(command(1))
    now[0] += 5.0
    robot._take(command(2))
    assert (robot._session_id, robot.rejected) == (1, 1)


def test_fake_is_the_same_for_the_same_seed():
    def course(seed):
        link = FakeRobotLink(seed)
        link.connect()
        desired = DesiredState(waypoint=Waypoint(1, Pose(4.0, 3.0, 0.0)))
        return [run_until(link, desired, lambda s: True) for _ in range(200)]

    assert course(3) == course(3)
    assert course(3)[0].x != course(4)[0].x


def test_fake_passes_through_the_modes_of_the_robot(fake):
    desired = DesiredState(waypoint=Waypoint(1, Pose(4.0, 0.0, 0.0)))
    seen = [run_until(fake, DesiredState(), lambda s: s.mode is Mode.READY_TO_MAP_CAR).mode]
    seen += [run_until(fake, desired, lambda s: s.is_mapping_car).mode]
    seen += [run_until(fake, desired, lambda s: s.waypoint_result is WaypointResult.REACHED).mode]
    assert seen == [Mode.READY_TO_MAP_CAR, Mode.MAPPING_CAR, Mode.FOLLOWING_WAYPOINT]


def test_fake_keeps_its_pace_when_asked():
    pauses = []
    link = FakeRobotLink(seed=1, time_factor=4.0, sleep=pauses.append)
    link.connect()
    link.next_status(1.0)
    assert pauses == [pytest.approx(0.025)]


def test_closed_fake_says_that_it_is_not_connected(fake):
    fake.close()
    with pytest.raises(ConnectionFailed, match="not connected"):
        fake.send(DesiredState())


def test_command_line_names_a_busy_port_and_fails(capsys):
    with ConnectionServer() as busy:
        assert substitute.main(["--subscriber-port", str(busy.subscriber_port), "--publisher-port", "0"]) == 2
        assert str(busy.subscriber_port) in capsys.readouterr().err


def test_command_line_serves_a_link_until_it_is_ended():
    command = [sys.executable, "-m", "mtr_operator.robot_link.substitute", "--subscriber-port", "0",
               "--publisher-port", "0"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        try:
            words = process.stdout.readline().replace(",", " ").replace(".", " ").split()
            subscriber, publisher = (int(word) for word in words if word.isdigit())
            link = ZmqRobotLink("127.0.0.1", subscriber, publisher)
            link.connect()
            assert link.next_status(5.0) is not None
            link.close()
        finally:
            process.terminate()
