"""Effects of faults on messages: none, repeated, meaningless or late; and the beginning and end of faults."""
# SPDX-License-Identifier: Apache-2.0
import io
import math
import random

import pytest
import rospy
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan

from mtr_fault_injection.parts import NODES, PARTS, SENSORS, FaultError, Kind, catalogue, kind_of, part_of
from mtr_fault_injection.schedule import MAX_DURATION_S, Schedule, fault_of
from mtr_fault_injection.spoiling import Spoiler, garbled
from mtr_msgs.msg import FirmwareState


def test_catalogue_offers_what_is_accepted_and_nothing_else():
    offered = catalogue()
    assert set(offered) == set(PARTS)
    assert all(kind_of(part_of(part), kind).value == kind for part, kinds in offered.items() for kind in kinds)
    assert offered["servos"] == ["off"]


def scan(number):
    message = LaserScan(ranges=[float(number)] * 4, range_max=30.0)
    message.header.stamp = rospy.Time(number)
    return message


def fault(kind, part="front_lidar", amount=0.0, duration_s=100.0):
    return fault_of(part, kind, duration_s, amount, 0.0)


def ranges(messages):
    return [(message.header.stamp.secs, message.ranges[0]) for message in messages]


def test_part_that_works_passes_everything_on_at_once():
    spoiler = Spoiler(1)
    messages = [scan(1), scan(2)]
    assert [spoiler.passed(message, None, 0.0) for message in messages] == [[each] for each in messages]


def test_part_that_is_off_says_nothing_until_it_works_again():
    spoiler = Spoiler(1)
    assert spoiler.passed(scan(1), fault("off"), 0.0) == []
    assert ranges(spoiler.passed(scan(2), None, 0.1)) == [(2, 2.0)]


def test_part_that_is_stuck_says_with_new_stamps_what_it_said_before():
    spoiler = Spoiler(1)
    spoiler.passed(scan(1), None, 0.0)
    said = [spoiler.passed(scan(number), fault("stuck"), 0.0)[0] for number in (2, 3)]
    assert ranges(said) == [(2, 1.0), (3, 1.0)]
    assert ranges(spoiler.passed(scan(4), None, 0.1)) == [(4, 4.0)]


@pytest.mark.parametrize("kind, amount, said", [
    ("empty", 0.0, [math.inf] * 5), ("dark", 0.0, [0.0] * 5), ("near", 0.0, [0.05] * 5),
    ("sector", 30.0, [1.0, 1.0, math.inf, 1.0, 1.0]), ("sector", 60.0, [1.0, math.inf, math.inf, math.inf, 1.0])])
def test_lidar_without_echoes_says_so_in_its_sector_and_its_header_stays(kind, amount, said):
    message = LaserScan(ranges=[1.0] * 5, angle_min=-math.pi / 2, angle_increment=math.pi / 4, range_max=30.0)
    message.header.stamp = rospy.Time(7)
    (spoilt,) = Spoiler(1).passed(message, fault(kind, amount=amount), 0.0)
    assert (spoilt.ranges, spoilt.header.stamp.secs) == (said, 7)
    assert message.ranges == [1.0] * 5


@pytest.mark.parametrize("kind", ["empty", "sector", "dark", "near"])
def test_only_lidars_can_be_without_echoes(kind):
    with pytest.raises(FaultError):
        kind_of(part_of("imu"), kind)


def imu(number):
    message = Imu(linear_acceleration=Vector3(0.0, 0.0, 9.81), angular_velocity=Vector3(0.0, 0.0, 0.2))
    message.header.stamp = rospy.Time(number)
    return message


def pitch_deg(message):
    force = message.linear_acceleration
    return math.degrees(math.atan2(-force.x, force.z))


def test_robot_whose_rear_is_lifted_turns_to_the_tilt_and_back_as_gyro_and_accelerometer_say():
    spoiler, turned_deg = Spoiler(1), 0.0
    for number in range(300):
        message = imu(number)
        (said,) = spoiler.passed(message, fault("tilt", "imu") if 50 <= number < 150 else None, 0.02 * number)
        turned_deg += math.degrees(said.angular_velocity.y) * 0.02
        assert pitch_deg(said) == pytest.approx(turned_deg, abs=1e-6) and said.header.stamp.secs == number
        assert math.hypot(said.linear_acceleration.x, said.linear_acceleration.z) == pytest.approx(9.81)
        assert (message.linear_acceleration.x, message.angular_velocity.y) == (0.0, 0.0)
        if number in (49, 299):
            assert said is message
        if 80 <= number < 150:
            assert pitch_deg(said) == pytest.approx(5.0)
            assert said.angular_velocity.x == pytest.approx(-0.2 * math.sin(math.radians(5.0)))


def test_tilt_has_its_degrees_and_is_a_fault_of_the_imu_alone():
    spoiler = Spoiler(1)
    said = [spoiler.passed(imu(number), fault("tilt", "imu", amount=3.0), 0.02 * number)[0] for number in range(100)]
    assert pitch_deg(said[-1]) == pytest.approx(3.0)
    with pytest.raises(FaultError):
        fault("tilt", "odometry")
    with pytest.raises(FaultError):
        fault("tilt", "imu", amount=91.0)


def test_board_that_is_stuck_repeats_its_clock_too():
    spoiler = Spoiler(1)
    spoiler.passed(FirmwareState(time_us=10), None, 0.0)
    assert spoiler.passed(FirmwareState(time_us=20), fault("stuck", "board"), 0.0)[0].time_us == 10


def test_garbage_is_fresh_and_of_the_right_size_and_means_nothing():
    spoilt = garbled(scan(7), random.Random(1))
    assert spoilt.header.stamp.secs == 7 and len(spoilt.ranges) == 4
    values = [garbled(Odometry(), random.Random(seed)).pose.pose.position.x for seed in range(200)]
    assert any(map(math.isnan, values)) and any(map(math.isinf, values)) and any(0.0 < abs(x) <= 1e3 for x in values)


def test_garbage_is_the_same_for_the_same_seed_and_the_message_itself_stays():
    message = scan(1)
    assert str(garbled(message, random.Random(5))) == str(garbled(message, random.Random(5)))
    assert list(message.ranges) == [1.0] * 4


def test_garbage_can_be_sent():
    for kind in (LaserScan, Odometry, FirmwareState):
        sent, again = io.BytesIO(), io.BytesIO()
        garbled(kind(), random.Random(3)).serialize(sent)
        kind().deserialize(sent.getvalue()).serialize(again)
        assert again.getvalue() == sent.getvalue()


def test_slow_part_is_late_by_the_amount_and_keeps_its_stamps_and_order():
    spoiler, slow = Spoiler(1), fault("slow", amount=0.25)
    arrived = [ranges(spoiler.passed(scan(number), slow, 0.1 * number)) for number in range(6)]
    assert arrived == [[], [], [], [(0, 0.0)], [(1, 1.0)], [(2, 2.0)]]
    assert ranges(spoiler.passed(scan(6), None, 0.6)) == [(3, 3.0), (4, 4.0), (5, 5.0), (6, 6.0)]


def test_fault_ends_by_itself_and_a_part_has_one_at_a_time():
    schedule = Schedule()
    schedule.begin(fault_of("imu", "off", 2.0, 0.0, 10.0))
    with pytest.raises(FaultError, match="imu off already"):
        schedule.begin(fault_of("imu", "stuck", 2.0, 0.0, 10.0))
    schedule.begin(fault_of("can", "off", 5.0, 0.0, 10.0))
    assert not schedule.ended(11.99) and [str(each) for each in schedule.ended(12.0)] == ["imu off"]
    assert [str(each) for each in schedule.active] == ["can off"] and schedule.of("imu") is None
    assert [str(each) for each in schedule.end("can")] == ["can off"] and schedule.end("can") == []


@pytest.mark.parametrize("asked, words", [
    (("wheel", "off", 1.0, 0.0), "There is no part 'wheel'; there are: front_lidar"),
    (("lift", "kill", 1.0, 0.0), "The part lift cannot be 'kill'; it can be: stuck, none"),
    (("imu", "off", 0.0, 0.0), "The duration is 0"), (("imu", "off", math.nan, 0.0), "The duration is nan"),
    (("imu", "off", 2.0 * MAX_DURATION_S, 0.0), "allowed is 0.02 to 3600 s"),
    (("imu", "off", 1.0, 2.0), "takes no amount"), (("imu", "slow", 1.0, -1.0), "The amount of slow is -1"),
    (("link_commands", "lose", 1.0, 1.5), "allowed is 0 to 1")])
def test_fault_that_cannot_be_is_refused_in_a_sentence(asked, words):
    with pytest.raises(FaultError, match=words):
        fault_of(*asked, 0.0)


def test_every_part_has_a_fault_and_what_it_takes_is_usual():
    for part in PARTS.values():
        assert part.kinds and all(kind_of(part, kind.value) is kind for kind in part.kinds)
    assert fault("slow").amount == 0.5 and fault("off").amount == 0.0
    assert set(SENSORS) | set(NODES) <= set(PARTS) and part_of("cpu").kinds == (Kind.SLOW, Kind.STOP)
