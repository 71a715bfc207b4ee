"""The application and the robot's link server with CURVE: both ends of what the other tests see from one side."""
# SPDX-License-Identifier: Apache-2.0
import time

import pytest
import zmq

from mtr_dispatcher.access.authorised_keys import Entry, Role
from mtr_dispatcher.access.curve import Curve
from mtr_dispatcher.access.gate import Gate
from mtr_dispatcher.access.key_folder import KeyFolder
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_operator.domain.errors import ConnectionFailed, LinkLost, RobotFailed
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Waypoint
from mtr_operator.robot_link.access.key_chain import KeyChain, PairedRobot
from mtr_operator.robot_link.client import VIEWER_NOTICE, ZmqRobotLink
from mtr_operator.robot_link.server import ConnectionServer

LIMIT_S = 5.0
DRIVE = DesiredState(waypoint=Waypoint(1, Pose(1.0, 2.0, 0.0)))


class Robot:
    """The dispatcher without ROS, on a steady clock that each of its Statuses moves by 0.1 s."""

    def __init__(self, folder, is_encrypted=True):
        self.folder, self.now_s = KeyFolder(folder), 100.0
        self.gate = Gate(self.folder.authorised, 500.0, lambda: self.now_s)
        self.core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
        curve = Curve(self.folder.own_keys(), self.gate.admits) if is_encrypted else None
        with ConnectionServer() as free:
            self.ports = Ports("127.0.0.1", free.subscriber_port, free.publisher_port)
        self.server = LinkServer(self.ports, curve)
        self.server.bind()

    def pair(self, chain, name="Jana", role=Role.CONTROLLER):
        """Both lists, as after a pairing."""
        key = chain.own_keys().public.decode()
        self.folder.change(lambda keys: keys.with_entry(Entry(name, role, "2026-11-23", key)))
        chain.keep(PairedRobot("127.0.0.1", self.folder.own_keys().public.decode(), role.value, "2026-11-23"))

    def link(self, chain, **options):
        """An application's link, not connected yet."""
        return ZmqRobotLink("127.0.0.1", self.ports.status_port, self.ports.command_port, chain=chain, **options)

    def step(self):
        """Take what has come, and send a Status."""
        for message in self.server.receive(0.01):
            sender = self.gate.sender(message.key, self.now_s)
            self.core.receive(message.data, self.now_s, sender)
        self.now_s += 0.1
        self.server.publish(self.core.status(Inputs(self.now_s, steady_s=self.now_s)))


@pytest.fixture
def robot(tmp_path):
    made = Robot(tmp_path / "robot")
    yield made
    made.server.close()


@pytest.fixture
def chain(tmp_path):
    return KeyChain(tmp_path / "laptop")


def status_where(robot, link, condition, desired=DRIVE):
    """The first Status of the link that fulfils the condition; each is answered."""
    end_s = time.monotonic() + LIMIT_S
    while time.monotonic() < end_s:
        robot.step()
        status = link.next_status(0.01)
        if status is not None:
            link.send(desired)
            if condition(status):
                return status
    raise AssertionError("No Status fulfilled the condition in time.")


def test_paired_laptop_controls_the_robot_and_its_name_comes_back(robot, chain):
    robot.pair(chain)
    link = robot.link(chain)
    link.connect()
    assert link.is_secret and not link.is_exposed
    status = status_where(robot, link, lambda status: status.session_id == link.session_id)
    assert status.controller_name == "Jana"
    link.close()


def test_laptop_that_comes_back_when_another_had_control_says_so_and_moves_nothing(robot, chain, tmp_path):
    others_chain = KeyChain(tmp_path / "another laptop")
    robot.pair(chain)
    robot.pair(others_chain, "Petr")
    links = [robot.link(each) for each in (chain, others_chain)]
    for link in links:
        link.connect()
        status_where(robot, link, lambda status, link=link: status.session_id == link.session_id)
    links[1].close()
    assert robot.core.session.session_id == links[1].session_id
    with pytest.raises(LinkLost, match="another application has controlled it"):
        status_where(robot, links[0], lambda _: False)
    assert robot.core.session.session_id == 0
    links[0].close()


def test_laptop_whose_key_was_revoked_is_told_to_pair_again(robot, chain):
    robot.pair(chain)
    robot.folder.change(lambda keys: keys.without("Jana"))
    with pytest.raises(ConnectionFailed, match="pair them again"):
        robot.link(chain).connect()
    assert robot.gate.refused["unknown key"] == 1


def test_laptop_without_encryption_is_not_let_in(robot, chain):
    with pytest.raises(ConnectionFailed, match="may be encrypted"):
        robot.link(chain, is_unencrypted=True).connect()


def test_another_robot_at_the_address_is_not_taken_for_the_paired_one(robot, chain):
    other, _ = zmq.curve_keypair()
    chain.own_keys()
    chain.keep(PairedRobot("127.0.0.1", other.decode(), "controller", "2026-11-23"))
    with pytest.raises(ConnectionFailed):
        robot.link(chain).connect()


def test_each_of_two_robots_with_one_address_is_found(robot, chain):
    robot.pair(chain)
    other, _ = zmq.curve_keypair()
    chain.keep(PairedRobot("127.0.0.1", other.decode(), "controller", "2026-11-24"))
    link = robot.link(chain)
    link.connect()
    assert link.is_secret
    link.close()


def test_viewer_sees_the_robot_and_cannot_order_it(robot, chain):
    robot.pair(chain, "Eva", Role.VIEWER)
    link = robot.link(chain)
    link.connect()
    status = status_where(robot, link, lambda _: True, DesiredState())
    assert VIEWER_NOTICE in status.notifications
    with pytest.raises(RobotFailed, match="viewer"):
        link.send(DRIVE)
    link.close()
    robot.step()
    assert robot.core.session.session_id == 0 and robot.core.rejected_messages == 0


def test_viewer_whose_application_sends_all_the_same_moves_nothing(robot, chain):
    robot.pair(chain, "Eva", Role.VIEWER)
    # A hostile application takes itself for a controller.
    chain.keep(PairedRobot("127.0.0.1", robot.folder.own_keys().public.decode(), "controller", "2026-11-23"))
    link = robot.link(chain)
    link.connect()
    status = status_where(robot, link, lambda status: status.notifications and
                          "key_refused" in {notice.code for notice in status.notifications})
    assert status.session_id == 0 and robot.core.desired(robot.now_s).stop_reason
    link.close()


def test_link_within_one_computer_needs_no_pairing_and_says_what_it_is(tmp_path, chain):
    robot = Robot(tmp_path / "robot", is_encrypted=False)
    link = robot.link(chain)
    link.connect()
    assert not link.is_secret and not link.is_exposed
    link.close()
    robot.server.close()
