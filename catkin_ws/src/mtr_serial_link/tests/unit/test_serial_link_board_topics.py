"""Allowed topics and services of a board."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from
from mtr_serial_link.board_topics import FIRMWARE_TOPICS, BoardTopic, Direction, board_topics
from mtr_serial_link.node import BridgeParameters

FIRMWARE_TABLE = pathlib.Path(__file__).resolve().parents[5] / "firmware" / "logic" / "link" / "endpoints.cpp"


def test_topic_is_read_from_direction_name_and_type():
    assert board_topics(["to /a std_msgs/Bool"]) == (BoardTopic(Direction.TO_BOARD, "/a", "std_msgs/Bool"),)


@pytest.mark.parametrize("text", ["", "to /a", "into /a std_msgs/Bool", "to a std_msgs/Bool", "to /a Bool",
                                  "to /a b/c d"])
def test_what_is_no_topic_is_refused_with_what_is_allowed(text):
    with pytest.raises(ConfigurationError, match="allowed is from, to or service"):
        board_topics([text])


def test_topics_of_the_firmware_are_those_that_it_offers():  # F1
    offered = re.findall(r'\{kTopic\w+, (\w+), \w+, "(/firmware/\w+)", MTR_(\w+)_TYPE', FIRMWARE_TABLE.read_text())
    served = {("kTopicNegotiate" if topic.direction is Direction.FROM_BOARD else "kTopicSubscriber", topic.name,
               topic.type_name.split("/")[1].upper()) for topic in board_topics(FIRMWARE_TOPICS)}
    assert served == set(offered) and len(offered) == 8


@pytest.mark.parametrize("host", ["rosserial_python", "bultin", ""])
def test_line_that_another_program_shall_serve_is_refused_with_a_sentence(host):  # F1
    with pytest.raises(ConfigurationError, match="allowed is 'builtin'"):
        parameters_from({"host": host}, BridgeParameters)
