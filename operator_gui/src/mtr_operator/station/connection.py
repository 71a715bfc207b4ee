"""The Operator's choice of connections: the robot's address, and a CAN adapter if already chosen."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import secrets
from dataclasses import dataclass
from typing import TYPE_CHECKING, Callable

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.errors import BusRefused, ConnectionFailed, InvalidParameter
from mtr_operator.domain.ports import CarLink, RobotLink
from mtr_operator.domain.results.document import OptionalInt
from mtr_operator.robot_link.address import PUBLISHER_PORT, SUBSCRIBER_PORT, RobotAddress

if TYPE_CHECKING:
    from mtr_operator.car_link.adapter import AdapterSettings
    from mtr_operator.car_link.can_frame import CanFrame
    from mtr_operator.car_link.learn.listener import Listener
    from mtr_operator.robot_link.virtual.robot import VirtualRobot

DEFAULT_BITRATE_BPS = 500_000
DEFAULT_PROFILE = "mtr_demo_car"
# Host of the robot's substitute and interface of the Car's, both inside the application.
SIMULATED = "simulated"
_SIMULATED_SEED = 1
_MAX_SESSION_ID = 2 ** 63 - 1


@dataclass(frozen=True)
class RobotChoice:
    """Address of the robot, or SIMULATED; the ports are named from the Operator's side.

    is_unencrypted: the person chose a connection without encryption, which a remote robot must permit too.
    """

    host: str = "127.0.0.1"
    subscriber_port: int = SUBSCRIBER_PORT
    publisher_port: int = PUBLISHER_PORT
    is_unencrypted: bool = False


@dataclass(frozen=True)
class BusChoice:
    """Adapter on a further bus of the Car, which only listens; bus: its name in the profile. The other attributes as in
    CanChoice."""

    bus: str
    interface: str
    channel: str = ""
    bitrate_bps: int = DEFAULT_BITRATE_BPS
    data_bitrate_bps: OptionalInt = None


@dataclass(frozen=True)
class CanChoice:
    """Adapter on the Car's bus and the profile of the Car; interface as named by python-can, or SIMULATED.

    data_bitrate_bps: of CAN FD, None for classic CAN. is_normal: the adapter is in normal mode; otherwise it sends
    nothing. further: adapters on the further buses that the profile declares.
    """

    interface: str
    channel: str = ""
    bitrate_bps: int = DEFAULT_BITRATE_BPS
    profile: str = DEFAULT_PROFILE
    data_bitrate_bps: OptionalInt = None
    is_normal: bool = False
    further: tuple[BusChoice, ...] = ()

    @property
    def places(self) -> tuple[tuple[str, str], ...]:
        """Return interface and channel of each adapter."""
        return ((self.interface, self.channel), *((each.interface, each.channel) for each in self.further))


@dataclass(frozen=True)
class Connection:
    """Content of the connection window. can: None before an adapter is chosen."""

    robot: RobotChoice = RobotChoice()
    can: CanChoice | None = None


def whole_number(text: str, name: str) -> int:
    """Return the number in a field; InvalidParameter names the field."""
    try:
        return int(text.strip())
    except ValueError:
        raise InvalidParameter(f"The {name} is {text.strip()!r}; allowed is a whole number.") from None


def robot_choice(host: str, subscriber_port: str, publisher_port: str, is_unencrypted: bool = False) -> RobotChoice:
    """Return the choice in the fields; InvalidParameter names a wrong one."""
    choice = RobotChoice(host.strip(), whole_number(subscriber_port, "subscriber port"),
                         whole_number(publisher_port, "publisher port"), is_unencrypted)
    RobotAddress(choice.host, choice.subscriber_port, choice.publisher_port)
    return choice


class LinkOpener:
    """Factory of the links for a choice; drivers are imported at their first use.

    The simulated robot continues from one link to the next, like a real robot: its clock, position and map are kept.
    time_factor: simulated seconds per second of wall time; 1 for a watching person, and because a real bus may be
    connected. car_seed: selects the Car of the Car's substitute.
    """

    def __init__(self, time_factor: float = 1.0, car_seed: int = 1):
        self._time_factor, self._car_seed = time_factor, car_seed
        self._simulated_robot: VirtualRobot | None = None

    def robot(self, choice: RobotChoice) -> RobotLink:
        """Return a new link of a new session, not connected yet; ConnectionFailed if the contract is not installed."""
        if choice.host == SIMULATED:
            return self._simulated()
        try:
            from mtr_operator.robot_link.client import ZmqRobotLink
        except ModuleNotFoundError as error:
            if (error.name or "").partition(".")[0] != "mtr_proto":
                raise
            raise ConnectionFailed("The package mtr_proto, the contract with the robot, is not installed; pip install "
                                   "the folder proto of the project.") from None
        return ZmqRobotLink(choice.host, choice.subscriber_port, choice.publisher_port,
                            is_unencrypted=choice.is_unencrypted)

    def _simulated(self) -> RobotLink:
        from mtr_operator.robot_link.fake import FakeRobotLink
        from mtr_operator.robot_link.virtual.robot import VirtualRobot
        if self._simulated_robot is None:
            self._simulated_robot = VirtualRobot.started(_SIMULATED_SEED)
        session_id = secrets.randbelow(_MAX_SESSION_ID) + 1
        return FakeRobotLink(time_factor=self._time_factor, robot=self._simulated_robot, session_id=session_id)

    def pair(self, host: str, code: str) -> str:
        """Pair this laptop with the robot that shows the code; return its role.

        InvalidParameter for an invalid address or code, ConnectionFailed if it does not succeed.
        """
        from mtr_operator.robot_link.access.pairing import pair
        return pair(host.strip(), code).role

    def listener(self, choice: CanChoice, heard: Callable[[CanFrame], None]) -> Listener:
        """Return the listener on the bus of a Car without a profile, not started; InvalidParameter for an impossible
        adapter."""
        from mtr_operator.car_link.adapter import AdapterSettings
        from mtr_operator.car_link.learn.listener import Listener
        return Listener(AdapterSettings(choice.interface, choice.channel, choice.bitrate_bps,
                                        is_listening=not choice.is_normal, data_bitrate_bps=choice.data_bitrate_bps),
                        heard)

    def car(self, choice: CanChoice | None) -> CarLink:
        """Return a new link, not connected yet; InvalidParameter, or BusRefused of a further bus, for an impossible
        adapter."""
        if choice is None:
            return AbsentCarLink()
        if choice.interface == SIMULATED:
            from mtr_operator.car_link.simulated_car import SimulatedCarLink
            return SimulatedCarLink(car_seed=self._car_seed)
        from mtr_operator.car_link.bus import CanCarLink
        return CanCarLink(choice.interface, choice.channel, choice.bitrate_bps, choice.profile,
                          is_listening=not choice.is_normal, data_bitrate=choice.data_bitrate_bps,
                          further={each.bus: _adapter(each) for each in choice.further})


def _adapter(choice: BusChoice) -> AdapterSettings:
    from mtr_operator.car_link.adapter import AdapterSettings
    try:
        return AdapterSettings(choice.interface, choice.channel, choice.bitrate_bps,
                               data_bitrate_bps=choice.data_bitrate_bps)
    except InvalidParameter as error:
        raise BusRefused(f"Further bus {choice.bus}: {error}", choice.bus) from None
