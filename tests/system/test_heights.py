"""The thesis' integration test: the Remote key reaches a height within 10 % and stays there for 5 s."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.robot_link.checks import HeightCheck, reach_and_hold_height
from mtr_operator.robot_link.client import ZmqRobotLink

# The lower stop, the thesis' three heights, and a way down again.
HEIGHTS_M = (0.35, 0.70, 1.024, 1.50, 0.40)


@pytest.fixture(scope="module")
def link(stack):
    """One session for all heights, as in the thesis: ids of a session never repeat."""
    connection = ZmqRobotLink("127.0.0.1", stack.status_port, stack.command_port)
    connection.connect()
    yield connection
    connection.close()


@pytest.mark.parametrize("height_m", HEIGHTS_M)
def test_key_reaches_a_height_and_holds_it_for_five_seconds(link, height_m):
    assert reach_and_hold_height(link, HeightCheck(height_m)) == ""
