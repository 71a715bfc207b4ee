"""Playback speed: never faster than the nodes follow, and without silent nodes."""
# SPDX-License-Identifier: Apache-2.0
import pytest
import rosbag
import rospy
from std_msgs.msg import Header

from mtr_core.schedule import CAR_LOCATOR, SIMULATION_START_NS
from mtr_recording.command_line import play
from mtr_recording.pace import Follower, Pace
from mtr_recording.player import FOLLOWER, HOLDERS, LATE_LIMIT_S, Played, in_time, opened_bags, recorded
from mtr_recording.profiles import CannotReplay

PATIENCE_S = 10.0


def ns(time_s):
    return round(time_s * 1e9)


@pytest.fixture
def pace():
    """Return the pace of a node that answers odometry, and one with ticks, the next of which is at 100.06 s."""
    made = Pace(Follower("/pose", "/odom", ns(0.1)), ["/car_locator"], PATIENCE_S)
    made.held("/car_locator", ns(100.06))
    return made


def test_nobody_is_behind_before_anything_is_played(pace):
    assert pace.behind(ns(100.0)) is None and pace.behind(ns(100.05)) is None


def test_nobody_is_left_behind_before_it_has_said_its_first_tick():
    assert Pace(Follower("/pose", "/odom", 0), ["/car_locator"], PATIENCE_S).behind(0) == "/car_locator"


def test_node_that_answers_owes_what_was_played_and_not_the_clock(pace):
    pace.held("/car_locator", ns(200.0))
    assert pace.behind(ns(105.0)) is None
    pace.played("/odom", ns(104.9))
    assert pace.behind(ns(105.0)) == "/pose"
    pace.answered(ns(104.81))
    assert pace.behind(ns(105.0)) is None


def test_silent_node_is_left_behind_and_counts_again_when_it_speaks(pace):
    assert not pace.has_waited("/car_locator", 6.0, 6.0) and pace.behind(ns(101.0)) == "/car_locator"
    assert pace.has_waited("/car_locator", 4.0, 10.0) and pace.behind(ns(101.0)) is None
    assert pace.waited_s == {"/car_locator": 10.0}
    pace.held("/car_locator", ns(100.16))
    assert pace.behind(ns(101.0)) == "/car_locator"


@pytest.mark.parametrize("begin_s", [0.1, 1_700_000_000.123456])
@pytest.mark.parametrize("step_s", [0.01, 0.0337, 0.3])
def test_no_tick_is_left_out_however_late_a_node_is(begin_s, step_s):
    pace, ticks, clock_ns = Pace(FOLLOWER, HOLDERS[:1], PATIENCE_S), [], ns(begin_s)
    # As in lockstep/ticker.py: before the first clock it waits for the start of the simulated one.
    tick_ns = CAR_LOCATOR.next_after(SIMULATION_START_NS)
    pace.held(HOLDERS[0], tick_ns)
    for _ in range(1000):
        while pace.behind(clock_ns):
            # The machine delays the node until now.
            assert tick_ns <= clock_ns, "both wait"
            if clock_ns - tick_ns < CAR_LOCATOR.period_ns:
                ticks.append(tick_ns)
            tick_ns = CAR_LOCATOR.next_after(clock_ns)
            pace.held(HOLDERS[0], tick_ns)
        clock_ns = pace.next_ns(clock_ns, clock_ns + ns(step_s))
    assert len(ticks) > 80
    assert {after - before for before, after in zip(ticks, ticks[1:])} == {CAR_LOCATOR.period_ns}


def bag_of(path, *times_s):
    with rosbag.Bag(str(path), "w") as bag:
        for time_s in times_s:
            bag.write("/a", Header(stamp=rospy.Time(time_s)), rospy.Time(time_s))
            bag.write("/b", Header(), rospy.Time(time_s))


def test_bags_in_any_order_are_played_in_the_order_of_their_times(tmp_path):
    bag_of(tmp_path / "late.bag", 3, 5)
    bag_of(tmp_path / "early.bag", 2, 4)
    bags = opened_bags([tmp_path / "late.bag", tmp_path / "early.bag"])
    assert [(played.time_s, played.topic) for played in recorded(bags, ["/a"])] == [(at, "/a") for at in range(2, 6)]


class Stamped:
    """Message with a header."""

    def __init__(self, stamp_s):
        self.header = Header(stamp=rospy.Time.from_sec(stamp_s))


# The recorder stopped from 1.0 to 1.3 s, and received one topic's messages before the other's.
STOOD = [Played(1.0, "/a", Stamped(1.0)), *(Played(1.3, topic, Stamped(stamp_s)) for topic in ("/a", "/b")
                                           for stamp_s in (1.1, 1.2, 1.3)), Played(1.4, "/c", Header())]


def test_clock_that_did_not_wait_for_the_recorder_has_messages_played_at_their_stamps():
    played = list(in_time(STOOD, by_stamps=True))
    assert [one.topic for one in played] == ["/a", "/a", "/b", "/a", "/b", "/a", "/b", "/c"]
    assert [one.time_s for one in played] == pytest.approx([1.0, 1.1, 1.1, 1.2, 1.2, 1.3, 1.3, 1.4])


def test_robots_messages_are_played_when_they_were_received():
    assert list(in_time(STOOD, by_stamps=False)) == STOOD


@pytest.mark.parametrize("stamp_s", [0.0, 100.0 - LATE_LIMIT_S, 100.0 + LATE_LIMIT_S, 1e6])
def test_stamp_far_from_its_receipt_does_not_count(stamp_s):
    neighbours = [Played(99.9, "/a", Stamped(99.9)), Played(100.1, "/a", Stamped(100.1))]
    played = list(in_time([neighbours[0], Played(100.0, "/b", Stamped(stamp_s)), neighbours[1]], by_stamps=True))
    assert [one.time_s for one in played] == pytest.approx([99.9, 100.0, 100.1])


def test_bag_that_is_none_is_told(tmp_path):
    (tmp_path / "no.bag").write_bytes(b"no bag")
    for name in ("no.bag", "away.bag"):
        with pytest.raises(CannotReplay, match=f"{name} cannot be read: "):
            opened_bags([tmp_path / name])


@pytest.mark.parametrize("rate", ["0", "nan", "21", "fast"])
def test_rate_that_cannot_be_is_refused(rate, capsys):
    with pytest.raises(SystemExit) as caught:
        play(["a.bag", "--rate", rate])
    assert caught.value.code == 2 and "--rate" in capsys.readouterr().err
