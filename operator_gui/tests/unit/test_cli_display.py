"""What the command line says of the robot while a test runs."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import io

from mtr_operator.cli.display import Display
from mtr_operator.domain.robot_status import Mode, Notification
from mtr_operator.robot_link.virtual.robot import VirtualRobot


def said_of(*texts):
    """Lines for Statuses with one notice each."""
    stream = io.StringIO()
    display = Display(None, stream)
    status = dataclasses.replace(VirtualRobot(1).status(), mode=Mode.FAULT)
    for text in texts:
        display.on_status(dataclasses.replace(status, notifications=(Notification("silent", 3, text),)))
    return stream.getvalue().splitlines()


def test_silence_that_grows_is_told_once():
    lines = said_of(*(f"The motion planner has been silent for {tenths / 10} s." for tenths in range(5, 30)))
    assert lines == ["robot error: The motion planner has been silent for 0.5 s."]


def test_another_sentence_of_the_same_kind_is_told():
    lines = said_of("The motion planner has been silent for 0.5 s.", "The Car locator has been silent for 0.5 s.")
    assert [line.partition(" has")[0] for line in lines] == ["robot error: The motion planner",
                                                             "robot error: The Car locator"]
