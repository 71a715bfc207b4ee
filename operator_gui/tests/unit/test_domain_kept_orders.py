"""Nothing new is ordered before all that was found is on disk; a robot is answered, and stopped, meanwhile."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.exchange.run_context import RunContext
from mtr_operator.domain.kept_orders import DISK_PATIENCE_S
from mtr_operator.domain.results.journal import Journal
from mtr_operator.domain.results.line_result import LineStatus


class SlowJournal(Journal):
    """Says so many times that it has not kept all. Attributes: waits: for how long it was waited."""

    def __init__(self, looks=0):
        self.looks, self.waits, self.failure = looks, [], None

    def wait(self, patience_s=math.inf):
        self.waits.append(patience_s)
        self.looks -= 1
        return self.looks < 0 or math.isinf(patience_s)

    def check(self):
        failure, self.failure = self.failure, None
        if failure:
            raise failure


@pytest.fixture
def loop(world, robot_link, car_link):
    """Of a robot whose time goes on."""
    world.spoil = lambda status: replace(status, waits_for_answer=False)
    made = ControlLoop(robot_link, car_link)
    made.step()
    return made


def heights(robot_link):
    return [desired.key_height_m for _, desired in robot_link.answers]


def test_each_status_is_answered_and_the_new_order_leaves_when_the_disk_has_written(loop, robot_link):
    loop.change(key_height_m=0.5)
    loop.step()
    loop.context = RunContext(journal=SlowJournal(looks=2))
    loop.change(key_height_m=0.9)
    for _ in range(4):
        loop.step()
    assert heights(robot_link) == [0.5, 0.5, 0.5, 0.9, 0.9]
    assert [status for status, _ in robot_link.answers] == [1, 2, 3, 4, 5]
    assert set(loop.context.journal.waits) == {DISK_PATIENCE_S}


def test_stop_waits_for_no_disk(loop, robot_link):
    loop.change(stop=False)
    loop.step()
    loop.context = RunContext(journal=SlowJournal(looks=100))
    loop.change(stop=True)
    loop.step()
    assert robot_link.answers[-1][1].stop


def test_robot_whose_time_stands_still_until_it_is_answered_waits_for_the_disk(loop, world, robot_link):
    world.spoil = lambda status: replace(status, waits_for_answer=True)
    loop.step()
    loop.context = RunContext(journal=SlowJournal(looks=100))
    loop.change(key_height_m=0.9)
    loop.step()
    assert heights(robot_link)[-1] == 0.9 and loop.context.journal.waits == [math.inf]


def test_settling_answers_until_all_is_kept(loop, robot_link):
    answers = len(robot_link.answers)
    loop.context = RunContext(journal=SlowJournal(looks=7))
    loop.settle()
    assert len(robot_link.answers) > answers and loop.context.journal.looks < 0


def test_point_is_safe_before_anything_else_is_said_or_done(loop):
    loop.context = RunContext(journal=SlowJournal(looks=7))
    Robot(loop, ()).keep("unlock", LineStatus.OK)
    assert loop.context.journal.looks < 0


def test_operator_can_end_a_test_whose_disk_never_writes(loop, robot_link):
    loop.context = RunContext(journal=SlowJournal(looks=10 ** 9))
    ended = ControlLoop(robot_link, loop.car_link, is_cancelled=lambda: len(robot_link.answers) > 5)
    ended.step()
    ended.context = loop.context
    with pytest.raises(Cancelled):
        ended.settle()
    assert ended.halt() and robot_link.answers[-1][1].stop


@pytest.mark.parametrize("act", ["step", "settle"])
def test_what_could_not_be_kept_ends_the_test(loop, act):
    loop.context = RunContext(journal=SlowJournal())
    loop.context.journal.failure = OutputError("The disk is full.")
    with pytest.raises(OutputError, match="full"):
        getattr(loop, act)()
