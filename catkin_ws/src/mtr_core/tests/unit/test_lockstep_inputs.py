"""Ages of messages on the robot's own clock during clock steps. A10"""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
import rospy
from std_msgs.msg import Header

from mtr_core.liveness import Instant
from mtr_core.lockstep import inputs
from mtr_core.lockstep.inputs import TickInput
from mtr_core.schedule import MILLISECOND_NS, slot

STEPS_S = [0.05, -0.05, 0.4, -0.4, 60.0, -60.0, 3600.0, -3600.0]
PERIOD_NS = 100 * MILLISECOND_NS


class Message:
    """A message with a header."""

    def __init__(self, stamp_ns):
        self.header = Header(stamp=rospy.Time(0, stamp_ns))


class Clocks:
    """The robot's clock, which the test sets, and the steady clock."""

    def __init__(self):
        self.steady, self.offset = 50_000 * MILLISECOND_NS, 10_000_000 * MILLISECOND_NS

    def is_simulated(self):
        return False

    is_lockstep = is_simulated

    def steady_at(self, _tick_ns):
        return self.steady

    def reading(self):
        return Instant(self.steady + self.offset, self.steady)


@pytest.fixture
def clocks(monkeypatch):
    known = Clocks()
    monkeypatch.setattr(inputs, "clock", known)
    monkeypatch.setattr(inputs.rospy, "get_param", lambda name, default: default)
    monkeypatch.setattr(inputs.rospy, "Subscriber", lambda *arguments, **options: None)
    return known


@pytest.fixture
def topic(clocks):
    return TickInput("/topic", Message, slot(100))


def arrive(clocks, topic, age_ns=0):
    topic._take(Message(clocks.reading().clock_ns - age_ns))


def test_before_the_first_message_nothing_is_fresh(topic):
    assert topic.fresh_at(0, 0.5) is None and topic.age_s(0) == math.inf


def test_message_that_nothing_follows_grows_old(clocks, topic):
    arrive(clocks, topic, 20 * MILLISECOND_NS)
    assert topic.fresh_at(0, 0.5) is not None and topic.age_s(0) == pytest.approx(0.02)
    clocks.steady += 470 * MILLISECOND_NS
    assert topic.fresh_at(0, 0.5) is not None
    clocks.steady += 20 * MILLISECOND_NS
    assert topic.fresh_at(0, 0.5) is None


@pytest.mark.parametrize("step_s", STEPS_S)
def test_setting_the_clock_makes_no_living_part_dead_and_no_dead_one_alive(clocks, topic, step_s):
    for _ in range(3):
        arrive(clocks, topic)
        clocks.steady += PERIOD_NS
    clocks.offset += round(step_s * 1e9)
    ages_s = []
    for _ in range(3):
        assert topic.fresh_at(0, 0.5) is not None
        ages_s.append(topic.age_s(0))
        arrive(clocks, topic, 10 * MILLISECOND_NS)
        clocks.steady += PERIOD_NS
    assert ages_s == pytest.approx([0.1, 0.11, 0.11])
    clocks.steady += 500 * MILLISECOND_NS
    assert topic.fresh_at(0, 0.5) is None


@pytest.mark.parametrize("step_s", STEPS_S)
def test_message_that_was_under_way_when_the_clock_was_set_is_as_old_as_it_is(clocks, topic, step_s):
    arrive(clocks, topic)
    clocks.steady += PERIOD_NS
    message = Message(clocks.reading().clock_ns)
    clocks.steady += 5 * MILLISECOND_NS
    clocks.offset += round(step_s * 1e9)
    topic._take(message)
    assert topic.fresh_at(0, 0.5) is message and abs(topic.age_s(0)) < 0.06
