"""How fast a recording is played: never faster than the nodes follow, and on without those that are silent."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
import rosbag
import rospy
from std_msgs.msg import Header

from mtr_bringup.recording.command_line import play
from mtr_bringup.recording.pace import Follower, Pace
from mtr_bringup.recording.player import CLOCK_STEP_S, FOLLOWERS, LATE_LIMIT_S, Played, in_time, opened_bags, recorded
from mtr_bringup.recording.profiles import CannotReplay
from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.schedule import CAR_LOCATOR, STATE_MACHINE

PATIENCE_S = 10.0


@pytest.fixture
def pace():
    """Of a node that answers odometry, and one that speaks ten times a second; the recording begins at 100 s."""
    made = Pace([Follower("/pose", 0.1, "/odom"), Follower("/car", 0.3)], PATIENCE_S)
    made.begin(100.0)
    return made


def test_nobody_is_behind_before_anything_is_played(pace):
    assert pace.behind(100.0) is None and pace.behind(100.29) is None


def test_node_that_answers_owes_what_was_played_and_not_the_clock(pace):
    pace.answered("/car", 105.0)
    assert pace.behind(105.0) is None
    pace.played("/odom", 104.9)
    assert pace.behind(105.0) == "/pose"
    pace.answered("/pose", 104.81)
    assert pace.behind(105.0) is None


def test_node_with_ticks_owes_the_clock(pace):
    assert pace.behind(100.31) == "/car"
    pace.answered("/car", 100.1)
    assert pace.behind(100.39) is None and pace.behind(100.41) == "/car"


def test_silent_node_is_given_up_and_counts_again_when_it_speaks(pace):
    assert not pace.has_waited("/car", 6.0, 6.0) and pace.behind(101.0) == "/car"
    assert pace.has_waited("/car", 4.0, 10.0) and pace.behind(101.0) is None
    assert pace.waited_s == {"/car": 10.0}
    pace.answered("/car", 100.5)
    assert pace.behind(101.0) == "/car"


@pytest.mark.parametrize("phase_s", [0.0, 0.02, 0.06, 0.09])
@pytest.mark.parametrize("topic, slot", [(names.CAR_ESTIMATE, CAR_LOCATOR), (names.ROBOT_MODE, STATE_MACHINE)])
def test_node_that_is_as_late_as_it_can_be_never_waits_for_a_player_that_waits_for_it(topic, slot, phase_s):
    (follower,) = (each for each in FOLLOWERS.values() if each.topic == topic)
    pace, period_s = Pace([follower], PATIENCE_S), slot.period_ns * NS
    tick_s = phase_s + period_s
    pace.begin(phase_s)
    pace.answered(topic, phase_s)
    for step in range(1000):
        clock_s = phase_s + step * CLOCK_STEP_S
        while pace.behind(clock_s):
            # The machine lets the node go on only now; as lockstep/ticker.py does, it leaves out a tick of long ago.
            assert tick_s <= clock_s, "both wait"
            if clock_s - tick_s < period_s:
                pace.answered(topic, tick_s)
            tick_s += period_s * math.ceil((clock_s - tick_s) / period_s + 1e-9)


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
    """A message with a header."""

    def __init__(self, stamp_s):
        self.header = Header(stamp=rospy.Time.from_sec(stamp_s))


# The recorder stood from 1.0 to 1.3 s, and had one topic's messages before the other's.
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
