"""Expected topics and services of a board: name, type and direction of each."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Dict, Iterable, NamedTuple, Tuple

from mtr_core import names
from mtr_core.errors import ConfigurationError

from .wire import ReservedId


class Direction(enum.Enum):
    """Direction as written in parameters."""

    FROM_BOARD = "from"
    TO_BOARD = "to"
    SERVICE = "service"


class BoardTopic(NamedTuple):
    """One topic or service; a service has messages in both directions."""

    direction: Direction
    name: str
    type_name: str


DIRECTION_OF: Dict[ReservedId, Direction] = {
    ReservedId.PUBLISHER: Direction.FROM_BOARD, ReservedId.SUBSCRIBER: Direction.TO_BOARD,
    ReservedId.SERVICE_REQUEST: Direction.SERVICE, ReservedId.SERVICE_RESPONSE: Direction.SERVICE}

# Topics of the project's own firmware, firmware/logic/link/endpoints.cpp.
FIRMWARE_TOPICS = (
    f"from {names.FIRMWARE_STATE} mtr_msgs/FirmwareState",
    f"from {names.FIRMWARE_HEALTH} mtr_msgs/FirmwareHealth",
    f"from {names.FIRMWARE_ECHO} mtr_msgs/FirmwareEcho",
    f"from {names.FIRMWARE_INPUTS} mtr_msgs/FirmwareInputs",
    f"to {names.FIRMWARE_COMMAND} mtr_msgs/FirmwareCommand",
    f"to {names.FIRMWARE_PRESS} mtr_msgs/FirmwarePress",
    f"to {names.FIRMWARE_CALIBRATE} mtr_msgs/FirmwareCalibrate",
    f"to {names.FIRMWARE_SIGNALS} mtr_msgs/FirmwareSignals",
)


def board_topics(texts: Iterable[str]) -> Tuple[BoardTopic, ...]:
    """Parse topics written as "direction name type"; ConfigurationError names an invalid one."""
    return tuple(_topic_of(text) for text in texts)


def _topic_of(text: str) -> BoardTopic:
    words = text.split()
    directions = {direction.value: direction for direction in Direction}
    if len(words) != 3 or words[0] not in directions or not words[1].startswith("/") or words[2].count("/") != 1:
        raise ConfigurationError(f"Parameter topics has '{text}'; allowed is from, to or service, a name that begins "
                                 "with /, and a type such as mtr_msgs/FirmwareState.")
    return BoardTopic(directions[words[0]], words[1], words[2])
