"""Subscriptions of the locator without a ROS master: selection of scans, and time from which a map is used."""
# SPDX-License-Identifier: Apache-2.0
import threading

import genpy
import pytest
from sensor_msgs.msg import LaserScan

from mtr_car_locator import sensors
from mtr_description.shipped import shipped_geometry
from mtr_msgs.msg import LocalizedPose, SurfaceMap

MILLISECOND_NS = 1_000_000


class FakeQueue:
    """A topic whose messages have all arrived.

    Attributes:
        opened: currently open topics.
    """

    opened = []
    messages = {}

    def __init__(self, topic, *_):
        self.topic = topic
        FakeQueue.opened.append(topic)

    def take(self, tick_ns):
        return self.messages.get(self.topic, [])

    def close(self):
        FakeQueue.opened.remove(self.topic)


@pytest.fixture(autouse=True)
def topics(monkeypatch):
    FakeQueue.opened, FakeQueue.messages = [], {}
    monkeypatch.setattr(sensors, "StampedQueue", FakeQueue)
    monkeypatch.setattr(sensors.rospy, "Subscriber", lambda *_, **__: None)
    return FakeQueue.messages


def stamped(message, time_ms):
    message.header.stamp = genpy.Time(0, time_ms * MILLISECOND_NS)
    return message


def test_scans_are_heard_only_while_they_are_wanted_and_none_of_the_first_200_ms(topics):
    source = sensors.ScanSource(shipped_geometry().lidars())
    topics["/front/scan"] = [stamped(LaserScan(), 1150), stamped(LaserScan(), 1250)]
    assert source.take(1000 * MILLISECOND_NS, False) == [] and not FakeQueue.opened
    scans = source.take(1000 * MILLISECOND_NS, True)
    assert [scan.start_s for scan in scans] == pytest.approx([1.25])
    assert FakeQueue.opened == ["/front/scan", "/rear/scan"]
    assert source.take(1100 * MILLISECOND_NS, False) == [] and not FakeQueue.opened


def test_scans_count_again_soon_after_the_clock_was_set_back(topics):
    source = sensors.ScanSource(shipped_geometry().lidars())
    source.take(3600_000 * MILLISECOND_NS, True)
    assert source.take(1000 * MILLISECOND_NS, True) == []
    topics["/front/scan"] = [stamped(LaserScan(), 1150), stamped(LaserScan(), 1250)]
    assert [scan.start_s for scan in source.take(1400 * MILLISECOND_NS, True)] == pytest.approx([1.25])


def test_poses_that_are_not_valid_are_left_out(topics):
    source = sensors.PoseSource()
    topics["/localization/pose"] = [stamped(LocalizedPose(valid=True, map_revision=3), 1000),
                                    stamped(LocalizedPose(valid=False, map_revision=9), 1020)]
    assert len(source.take(1060 * MILLISECOND_NS)) == 1
    assert source.map_revision == 3


def test_map_counts_when_the_pose_is_in_it_or_some_time_after_its_stamp(monkeypatch):
    monkeypatch.setattr(sensors, "is_lockstep", lambda: False)
    source = sensors.MapSource()
    assert source.at(1000 * MILLISECOND_NS, 1) is None
    source._take(stamped(SurfaceMap(map_car_id=7, revision=2, valid=True), 1040))
    assert source.at(1060 * MILLISECOND_NS, 1) is None
    assert source.at(1060 * MILLISECOND_NS, 2).map_id == 7
    assert source.at(1160 * MILLISECOND_NS, 1).revision == 2


def test_simulated_tick_waits_for_the_map_that_the_pose_speaks_of(monkeypatch):
    monkeypatch.setattr(sensors, "is_lockstep", lambda: True)
    monkeypatch.setattr(sensors, "patience_at_least_s", lambda usual_s: usual_s)
    source = sensors.MapSource()
    sender = threading.Timer(0.05, source._take, [stamped(SurfaceMap(map_car_id=7, revision=1, valid=True), 1040)])
    sender.start()
    assert source.at(1060 * MILLISECOND_NS, 1).revision == 1
    sender.join()


def test_simulated_tick_does_not_wait_for_ever(monkeypatch):
    monkeypatch.setattr(sensors, "is_lockstep", lambda: True)
    monkeypatch.setattr(sensors, "patience_at_least_s", lambda usual_s: 0.01)
    assert sensors.MapSource().at(1060 * MILLISECOND_NS, 1) is None
