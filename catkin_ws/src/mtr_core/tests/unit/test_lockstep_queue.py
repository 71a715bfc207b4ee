"""A topic whose messages are all processed, without a ROS master."""
# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

import pytest
import rospy
from std_msgs.msg import Header

from mtr_core.lockstep import stamped_queue
from mtr_core.schedule import MILLISECOND_NS, SENSORS

LAG_NS = 100 * MILLISECOND_NS


class Stamped:
    """A message with a header."""

    def __init__(self, time_ms):
        self.header = Header(stamp=rospy.Time.from_sec(time_ms / 1000.0))


@pytest.fixture
def queue(monkeypatch):
    monkeypatch.setattr(stamped_queue, "is_lockstep", lambda: False)
    monkeypatch.setattr(stamped_queue.rospy, "Subscriber", lambda *_, **__: None)
    return stamped_queue.StampedQueue("/topic", Stamped, SENSORS, LAG_NS)


def taken(queue, tick_ms):
    return [message.header.stamp.to_nsec() // MILLISECOND_NS for message in queue.take(tick_ms * MILLISECOND_NS)]


@pytest.fixture
def waiting(queue):
    for time_ms in (5000, 5040, 5080):
        queue._take_in(Stamped(time_ms))
    return queue


def test_messages_are_handed_over_once_and_in_order_when_they_are_due(waiting):
    assert [taken(waiting, tick_ms) for tick_ms in (5099, 5140, 5140, 5200)] == [[], [5000, 5040], [], [5080]]


@pytest.mark.parametrize("back_ms", [1000, 4900])
def test_messages_after_the_clock_was_set_back_do_not_wait_for_those_of_before(waiting, back_ms):
    """The clock steps back: messages stamped before the step are dropped."""
    now_ms = 5120 - back_ms
    waiting._take_in(Stamped(now_ms))
    assert taken(waiting, now_ms + 100) == [now_ms]


@pytest.mark.parametrize("connected_at_ms, waits_from_ms", [(0, 1200), (1500, 1680)])
def test_in_lockstep_it_waits_for_what_is_due_from_shortly_after_the_connection_on(
        monkeypatch, connected_at_ms, waits_from_ms):
    now_ms, asked_ms = [0], []
    subscriber = SimpleNamespace(get_num_connections=lambda: int(now_ms[0] >= connected_at_ms))
    monkeypatch.setattr(stamped_queue, "is_lockstep", lambda: True)
    monkeypatch.setattr(stamped_queue.rospy, "Subscriber", lambda *_, **__: subscriber)
    monkeypatch.setattr(stamped_queue.rospy, "get_param", lambda _, default: default)
    monkeypatch.setattr(stamped_queue.rospy, "get_published_topics", lambda: [])
    late = stamped_queue.StampedQueue("/topic", Stamped, SENSORS, LAG_NS)
    monkeypatch.setattr(late._samples, "at", lambda tick_ns: asked_ms.append(tick_ns // MILLISECOND_NS))
    for now_ms[0] in range(1000, 2000, 20):
        late.take(now_ms[0] * MILLISECOND_NS)
    assert asked_ms[0] == waits_from_ms
