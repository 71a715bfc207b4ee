"""Topics that are missing, doubled, slow, old, from the future or empty are reported with value, limit and remedy."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_commissioning.preflight.expected import Setup, expected_topics
from mtr_commissioning.preflight.records import RobotRecord, ScanContent, TopicRecord
from mtr_commissioning.preflight.topics import topic_findings
from mtr_core import names

SETUP = Setup(controller=False)
FULL_SCAN = ScanContent(720, 500, 0, 0.03)


def heard(expected, seconds=5.0, age_s=0.01):
    """Return a topic without faults."""
    times = [index * expected.period_s for index in range(int(seconds / expected.period_s))]
    record = TopicRecord(expected.type, ("/driver",), times)
    if expected.max_age_s:
        record.ages_s = [age_s] * len(times)
    if expected.type.endswith("LaserScan"):
        record.scans = [FULL_SCAN] * len(times)
    return record


def robot(setup=SETUP):
    """Return a record of a robot without faults."""
    topics = {expected.topic: heard(expected) for expected in expected_topics(setup)}
    topics[names.WHEEL_COMMAND] = TopicRecord("geometry_msgs/Twist", ("/drive_control",))
    return RobotRecord(topics, listened_s=5.0)


def bad_findings(record, setup=SETUP):
    return [finding for finding in topic_findings(record, setup) if finding.is_bad]


def only_bad(record, setup=SETUP):
    """Return the only bad finding."""
    found = bad_findings(record, setup)
    assert len(found) == 1, [finding.line() for finding in found]
    return found[0]


def test_right_robot_has_one_good_line_for_each_topic():
    findings = topic_findings(robot(), SETUP)
    assert not bad_findings(robot())
    assert len(findings) == len(expected_topics(SETUP)) + 1
    assert findings[1].text == ("25.0 Hz, longest gap 0.040 s, age 0.010 s (median), 0.010 s (worst).")


@pytest.mark.parametrize("topic", [expected.topic for expected in expected_topics(SETUP)])
def test_missing_topic_is_named_with_its_remedy(topic):
    record = robot()
    del record.topics[topic]
    finding = only_bad(record)
    assert finding.check == "topic.present" and finding.subject == topic and "No node publishes it" in finding.text


def test_topics_that_this_robot_does_not_have_are_not_missed():
    topics = {expected.topic for expected in expected_topics(Setup(rear_lidar=False, controller=False))}
    assert names.REAR_SCAN not in topics and names.JOY not in topics
    assert names.JOY in {expected.topic for expected in expected_topics(Setup())}


def test_two_publishers_are_both_named():
    record = robot()
    record.topics[names.FRONT_SCAN].publishers = ("/a", "/b")
    finding = only_bad(record)
    assert finding.check == "topic.publishers" and "/a, /b" in finding.text and finding.value == 2


@pytest.mark.parametrize("nodes, is_bad", [((), True), (("/drive_control",), False),
                                           (("/drive_control", "/twist_mux"), True)])
def test_exactly_one_node_commands_the_wheels(nodes, is_bad):
    record = robot()
    record.topics[names.WHEEL_COMMAND].publishers = nodes
    assert bool(bad_findings(record)) is is_bad


def test_wrong_type_is_told_instead_of_silence():
    record = robot()
    record.topics[names.FRONT_SCAN] = TopicRecord("sensor_msgs/PointCloud2", ("/velodyne",))
    assert "sensor_msgs/PointCloud2, allowed is sensor_msgs/LaserScan" in only_bad(record).text


def test_node_that_publishes_nothing_is_named():
    record = robot()
    record.topics[names.IMU_DATA] = TopicRecord("sensor_msgs/Imu", ("/imu_driver",))
    assert "/imu_driver publishes it, but 0 messages came in 5.0 s" in only_bad(record).text


@pytest.mark.parametrize("rate_hz, is_bad", [(25.0, False), (20.5, False), (19.5, True), (15.0, True)])
def test_lidar_slower_than_four_fifths_is_bad(rate_hz, is_bad):
    record = robot()
    record.topics[names.FRONT_SCAN].arrivals_s = [index / rate_hz for index in range(100)]
    assert [finding.check for finding in bad_findings(record)] == (["topic.rate"] if is_bad else [])


@pytest.mark.parametrize("gap_s, is_bad", [(0.11, False), (0.13, True)])
def test_longest_gap_has_a_limit(gap_s, is_bad):
    record = robot()
    times = record.topics[names.FRONT_SCAN].arrivals_s
    record.topics[names.FRONT_SCAN].arrivals_s = [time if time <= 2.0 else time + gap_s - 0.04 for time in times]
    assert [finding.check for finding in bad_findings(record)] == (["topic.gap"] if is_bad else [])


@pytest.mark.parametrize("age_s, is_bad", [(0.049, False), (0.051, True), (3600.0, True), (-0.004, False),
                                           (-0.006, True), (-3600.0, True)])
def test_stamps_of_another_clock_are_bad(age_s, is_bad):
    record = robot()
    record.topics[names.IMU_DATA].ages_s = [age_s] * 250
    assert [finding.check for finding in bad_findings(record)] == (["topic.age"] if is_bad else [])


def test_simulated_messages_may_overtake_the_clock_by_a_step():
    record = robot()
    record.topics[names.IMU_DATA].ages_s = [-0.02] * 250
    assert not bad_findings(record, replace(SETUP, is_simulated=True)) and bad_findings(record)


def test_single_old_message_is_told_by_its_age():
    record = robot()
    record.topics[names.IMU_DATA].ages_s[7] = 0.31
    finding = only_bad(record)
    assert finding.value == 0.31 and finding.limit == 0.1 and "up to 0.310 s old" in finding.text


@pytest.mark.parametrize("content, is_bad", [((720, 0, 0), True), ((0, 0, 0), True), ((720, 1, 0), False),
                                             ((720, 300, 100), True), ((720, 300, 60), False)])
def test_scans_that_see_nothing_or_no_numbers_are_bad(content, is_bad):
    record = robot()
    record.topics[names.REAR_SCAN].scans = [ScanContent(*content, 0.03)] * 125
    assert [finding.check for finding in bad_findings(record)] == (["scan.content"] if is_bad else [])


@pytest.mark.parametrize("scans, unseen_rad, is_bad", [(125, 0.349, True), (125, 0.17, False), (10, 0.349, False),
                                                       (15, 0.349, True)])
def test_piece_for_which_drive_control_stands_is_bad(scans, unseen_rad, is_bad):
    record = robot()
    record.topics[names.FRONT_SCAN].scans = ([FULL_SCAN._replace(not_numbers=53, unseen_rad=unseen_rad)] * scans
                                             + [FULL_SCAN] * (125 - scans))
    found = bad_findings(record)
    assert [finding.check for finding in found] == (["scan.content"] if is_bad else [])
    assert all("Up to 20 deg" in finding.text and "allowed is 10 deg" in finding.text for finding in found)


def test_beams_that_the_nodes_have_times_for_are_good():
    setup = replace(SETUP, time_increment_s=6.173e-5)
    record = robot(setup)
    record.topics[names.FRONT_SCAN].scans = [FULL_SCAN._replace(sweep_s=0.0)] * 125
    assert not bad_findings(record, setup)


@pytest.mark.parametrize("sweep_s, is_simulated, words", [
    (0.0, False, "do not say when each beam was measured"), (0.0, True, ""), (0.0, False, "time_increment is 0"),
    (0.0399, False, ""), (0.0432, False, "takes 0.043 s (time_increment), allowed is the 0.040 s"),
    (-0.03, False, "takes -0.030 s"), (30.0, True, "takes 30.000 s")])
def test_times_of_the_beams_are_judged(sweep_s, is_simulated, words):
    setup = replace(SETUP, is_simulated=is_simulated)
    record = robot(setup)
    record.topics[names.FRONT_SCAN].scans = [FULL_SCAN._replace(sweep_s=sweep_s)] * 125
    assert [finding.check for finding in bad_findings(record, setup)] == (["scan.beam_time"] if words else [])
    assert all(words in finding.text for finding in bad_findings(record, setup))


def test_beams_of_a_robot_whose_clock_stands_still_are_not_judged():
    record = robot()
    heard_scan = record.topics[names.FRONT_SCAN]
    heard_scan.scans, heard_scan.arrivals_s = [FULL_SCAN] * 2, [1.0, 1.0]
    assert [finding.check for finding in bad_findings(record)] == ["topic.rate"]
