"""Catalogue of parts and their kinds of fault; all other modules refer to these names."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Dict, List, NamedTuple, Tuple

from mtr_core.errors import RobotError

NONE = "none"


class FaultError(RobotError):
    """A fault cannot be injected; the text has the possible ones."""


class Kind(enum.Enum):
    """Behaviour of a faulty part."""

    OFF = "off"            # no output or no effect
    STUCK = "stuck"        # the same output repeated with new stamps; a lift that does not move
    GARBAGE = "garbage"    # meaningless numbers, or bytes that are not a message
    SLOW = "slow"          # everything `amount` s late; for a node or the computer: little processor time
    STOP = "stop"          # SIGSTOP, and SIGCONT at the end; a CAN controller that has left the bus
    KILL = "kill"          # SIGKILL, repeated while the fault lasts
    LOSE = "lose"          # a share of `amount` of the messages is lost
    DOUBLE = "double"      # each message is sent twice
    REORDER = "reorder"    # each pair of messages is swapped
    FORWARD = "forward"    # the clock is `amount` s ahead
    BACK = "back"          # the clock is `amount` s behind
    CLAIM = "claim"        # a foreign Operator sends Commands
    EMPTY = "empty"        # no beam of a LiDAR has an echo: +inf, as dazzled or covered LiDARs report
    SECTOR = "sector"      # like `empty`, within `amount` degrees on both sides of the LiDAR's x axis
    DARK = "dark"          # all beams of a LiDAR return zero
    NEAR = "near"          # a cap on the LiDAR: each beam returns 5 cm
    TILT = "tilt"          # IMU readings of a robot whose rear is lifted by `amount` degrees


class Place(enum.Enum):
    """Place where a fault acts."""

    MESSAGES = "messages"      # between a driver and the nodes
    SIMULATOR = "simulator"    # in the simulated hardware
    LINK = "link"              # in the relay of the link
    NODE = "node"              # on a process
    MACHINE = "machine"        # on the computer


class Part(NamedTuple):
    """Part with its possible kinds of fault."""

    name: str
    place: Place
    kinds: Tuple[Kind, ...]


_OF_MESSAGES = (Kind.OFF, Kind.STUCK, Kind.GARBAGE, Kind.SLOW)
_OF_LIDARS = (*_OF_MESSAGES, Kind.EMPTY, Kind.SECTOR, Kind.DARK, Kind.NEAR)
_OF_IMU = (*_OF_MESSAGES, Kind.TILT)
_OF_LINK = (Kind.OFF, Kind.SLOW, Kind.LOSE, Kind.DOUBLE, Kind.REORDER)
_OF_NODES = (Kind.STOP, Kind.KILL, Kind.SLOW)
LIDARS = ("front_lidar", "rear_lidar")
IMU = "imu"
SENSORS = (*LIDARS, IMU, "odometry", "gnss", "battery", "board")
NODES = ("base_guard", "car_locator", "controller_input", "dispatcher", "drive_control", "graph_watch", "localization",
         "motion_planner", "peripherals", "serial_bridge", "state_machine")
LIFT, SERVOS, CAN = "lift", "servos", "can"
LINK_COMMANDS, LINK_STATUSES, OPERATOR = "link_commands", "link_statuses", "operator"
CLOCK, DISK, CPU = "clock", "disk", "cpu"
_ALL = (
    *(Part(name, Place.MESSAGES, _OF_LIDARS if name in LIDARS else _OF_IMU if name == IMU else _OF_MESSAGES)
      for name in SENSORS),
    Part(LIFT, Place.SIMULATOR, (Kind.STUCK,)),
    Part(SERVOS, Place.SIMULATOR, (Kind.OFF,)),
    Part(CAN, Place.SIMULATOR, (Kind.OFF, Kind.GARBAGE, Kind.STOP)),
    Part(LINK_COMMANDS, Place.LINK, _OF_LINK),
    Part(LINK_STATUSES, Place.LINK, _OF_LINK),
    Part(OPERATOR, Place.LINK, (Kind.CLAIM, Kind.GARBAGE)),
    *(Part(name, Place.NODE, _OF_NODES) for name in NODES),
    Part(CLOCK, Place.MACHINE, (Kind.FORWARD, Kind.BACK)),
    Part(DISK, Place.MACHINE, (Kind.OFF,)),
    Part(CPU, Place.MACHINE, (Kind.SLOW, Kind.STOP)),
)
PARTS: Dict[str, Part] = {part.name: part for part in _ALL}
# Default amounts: s for slow, forward and back, a share for lose, degrees for sector and tilt.
USUAL_AMOUNTS: Dict[Kind, float] = {Kind.SLOW: 0.5, Kind.FORWARD: 0.4, Kind.BACK: 0.4, Kind.LOSE: 0.3,
                                   Kind.SECTOR: 45.0, Kind.TILT: 5.0}
MAX_AMOUNTS: Dict[Kind, float] = {Kind.SLOW: 10.0, Kind.FORWARD: 86400.0, Kind.BACK: 86400.0, Kind.LOSE: 1.0,
                                 Kind.SECTOR: 180.0, Kind.TILT: 90.0}


def catalogue() -> Dict[str, List[str]]:
    """Return the kinds of fault by part, as words."""
    return {part.name: [kind.value for kind in part.kinds] for part in _ALL}


def part_of(name: str) -> Part:
    """Return the part of a name.

    Raises:
        FaultError: the part does not exist.
    """
    if name not in PARTS:
        raise FaultError(f"There is no part {name!r}; there are: {', '.join(PARTS)}.")
    return PARTS[name]


def kind_of(part: Part, name: str) -> Kind:
    """Return the kind of fault of a name.

    Raises:
        FaultError: the part cannot have it.
    """
    for kind in part.kinds:
        if kind.value == name:
            return kind
    raise FaultError(f"The part {part.name} cannot be {name!r}; it can be: "
                     f"{', '.join(kind.value for kind in part.kinds)}, {NONE}.")
