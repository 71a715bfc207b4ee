"""A state that the Car sends only when it changes; and the message of the state on more than one bus."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
import re

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.further.spoken_frames import SpokenFrames
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.log.log_car import LogCarLink
from mtr_operator.car_link.profile import load_profile
from mtr_operator.cli.cars.trying import try_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID, SPEED_ID, OTHER_ID = 0x321, 0x1A0, 0x050
DATABASE = f"""VERSION ""
BU_: Body
BO_ {LOCK_ID} DOORS: 8 Body
 SG_ LOCK : 0|2@1+ (1,0) [0|3] "" Body
 SG_ COUNT : 8|8@1+ (1,0) [0|255] "" Body
 SG_ FAR : 32|16@1+ (1,0) [0|0] "dm" Body
 SG_ CHANGES : 16|4@1+ (1,0) [0|15] "" Body
BO_ {SPEED_ID} SPEED: 4 Body
 SG_ KMH : 0|16@1+ (1,0) [0|0] "" Body
 SG_ ALIVE : 16|4@1+ (1,0) [0|15] "" Body
"""
PROFILE = """database: car.dbc
message: DOORS
signal: LOCK
states: {1: locked, 2: unlocked}
"""
WHOLE_BUS = "sent_only_on_change: true"
MESSAGE = f"{WHOLE_BUS}\nliveness_message: SPEED\ncycle_time_s: 0.1"


def written(folder, lines):
    (folder / "car.dbc").write_text(DATABASE)
    path = folder / "car.yaml"
    path.write_text(f"{PROFILE}{lines}\n")
    return str(path)


class Bus:
    """Frames each 50 ms on the clock of the robot, and none of the state but with a change."""

    def __init__(self, path):
        self.watch = LockWatch(load_profile(path))
        self.now_s, self.step, self.events, self.silent = 10.0, 0, [], set()
        self.run(4.0)

    def send(self, can_id, data=bytes(8)):
        if can_id not in self.silent:
            self.watch.frame(CanFrame(can_id, False, data, self.now_s))

    def run(self, seconds):
        for _ in range(round(seconds / 0.05)):
            self.step += 1
            self.now_s = round(10.0 + 0.05 * self.step, 6)
            self.send(SPEED_ID if self.step % 2 else OTHER_ID)
            if self.step % 2 == 0:
                status = RobotStatus(self.step, 1, self.now_s, sent_s=self.now_s, steady_s=self.now_s)
                self.watch.status(status, self.now_s)
                self.events += self.watch.release(self.now_s)

    def change(self, state):
        """The time of the change."""
        self.now_s += 0.01
        self.send(LOCK_ID, bytes([1 if state is LockState.LOCKED else 2] + [0] * 7))
        return self.now_s


@pytest.mark.parametrize("lines", [WHOLE_BUS, MESSAGE], ids=["whole bus", "message"])
def test_change_has_its_own_time_and_long_rest_is_no_silence(tmp_path, lines):
    bus = Bus(written(tmp_path, lines))
    assert (bus.watch.lock_state, bus.watch.problem) == (LockState.UNKNOWN, "")
    bus.change(LockState.LOCKED)
    bus.run(60.0)
    assert (bus.watch.lock_state, bus.watch.problem, bus.events) == (LockState.LOCKED, "", [])
    changed_s = bus.change(LockState.UNLOCKED)
    bus.run(1.0)
    event, = bus.events
    assert (event.lock_state, event.doubt) == (LockState.UNLOCKED, "")
    assert event.time_s == pytest.approx(changed_s, abs=0.01) and event.time_sigma_s < 0.01
    again_s = bus.change(LockState.LOCKED)
    bus.run(1.0)
    assert [event.doubt for event in bus.events] == ["", ""]
    assert bus.events[-1].time_s == pytest.approx(again_s, abs=0.01)
    assert load_profile(written(tmp_path, lines)).facts.confirm_s == pytest.approx(0.1)


def test_change_that_is_taken_back_at_once_is_doubted(tmp_path):
    bus = Bus(written(tmp_path, MESSAGE))
    bus.change(LockState.LOCKED)
    bus.run(2.0)
    for state in (LockState.UNLOCKED, LockState.LOCKED):
        bus.change(state)
    bus.run(2.0)
    assert any("a state lasts at least 0.1 s" in event.doubt for event in bus.events)


def test_silence_of_the_message_is_told_by_its_name_and_the_state_is_forgotten(tmp_path):
    bus = Bus(written(tmp_path, MESSAGE))
    bus.change(LockState.LOCKED)
    bus.run(2.0)
    bus.silent = {SPEED_ID}
    bus.run(2.0)
    assert "No message SPEED (id 0x1A0) for" in bus.watch.problem
    bus.silent = set()
    bus.run(2.0)
    # A change may have been missed meanwhile.
    assert (bus.watch.lock_state, bus.watch.problem) == (LockState.UNKNOWN, "")


def test_silence_of_the_bus_is_told_and_the_state_is_forgotten(tmp_path):
    bus = Bus(written(tmp_path, WHOLE_BUS))
    bus.change(LockState.LOCKED)
    bus.silent = {SPEED_ID}
    bus.run(2.0)
    assert (bus.watch.lock_state, bus.watch.problem) == (LockState.LOCKED, "")
    bus.silent = {SPEED_ID, OTHER_ID}
    bus.run(2.0)
    assert "No CAN frame for" in bus.watch.problem
    bus.silent = set()
    bus.run(2.0)
    assert (bus.watch.lock_state, bus.watch.problem) == (LockState.UNKNOWN, "")


def test_lost_frame_leaves_the_state_unknown(tmp_path):
    bus = Bus(written(tmp_path, MESSAGE))
    bus.change(LockState.LOCKED)
    bus.run(2.0)
    bus.watch.forget_state()
    bus.run(1.0)
    assert bus.watch.lock_state is LockState.UNKNOWN
    bus.change(LockState.LOCKED)
    bus.run(1.0)
    assert (bus.watch.lock_state, bus.events) == (LockState.LOCKED, [])


@pytest.mark.parametrize("lines", [WHOLE_BUS, MESSAGE], ids=["whole bus", "message"])
def test_car_that_sends_its_state_only_on_change_passes_an_autolock(tmp_path, lines):
    tried = try_profile(written(tmp_path, lines))
    assert tried.is_good, tried
    assert not math.isinf(tried.worst_s)


@pytest.mark.parametrize("counters", [
    "alive_signal: COUNT", "alive_signal: COUNT\nalive_values: [1, 14]", "alive_signal: COUNT\ncommand_signal: CHANGES",
    "alive_signal: {message: SPEED, signal: ALIVE}", "alive_signal: {message: DOORS, signal: COUNT, values: 15}",
    "alive_signal: {message: SPEED, signal: ALIVE, values: [1, 15]}\ncommand_signal: CHANGES"])
@pytest.mark.parametrize("lines", [WHOLE_BUS, MESSAGE, "cycle_time_s: 0.1\nsent_on_change: true", "cycle_time_s: 0.1"],
                         ids=["whole bus", "message", "also on change", "cyclic"])
def test_counter_of_a_simulated_car_increases_with_each_frame(tmp_path, lines, counters):
    path = written(tmp_path, f"{lines}\n{counters}")
    profile, counts = load_profile(path), {}
    frames = SpokenFrames(profile)
    for index in range(200):
        frames.is_locked = index // 20 % 2 == 0
        for _, message in frames.next():
            counts.setdefault(message.arbitration_id, []).append(message.data)
    alive_id, byte, mask = (SPEED_ID, 2, 15) if "ALIVE" in counters else (LOCK_ID, 1, 255)
    values = [data[byte] & mask for data in counts[alive_id]]
    assert {after - before for before, after in itertools.pairwise(values) if after > before} == {1}
    assert try_profile(path).is_good


@pytest.mark.parametrize("message", ["DOORS", "SPEED"])
@pytest.mark.parametrize("alive", ["COUNT", "{message: SPEED, signal: ALIVE}"])
def test_distance_of_a_phone_does_not_disturb_a_counter_of_its_message(tmp_path, message, alive):
    distance = {"DOORS": "signal: FAR, unit: dm", "SPEED": "signal: KMH, unit: cm"}[message]
    lines = f"cycle_time_s: 0.1\nalive_signal: {alive}\nphone_distance: {{message: {message}, {distance}}}"
    tried = try_profile(written(tmp_path, lines))
    assert tried.is_good, tried


@pytest.mark.parametrize(("lines", "words"), [
    ("", "lacks the entry cycle_time_s"), ("sent_only_on_change: false", "lacks the entry cycle_time_s"),
    ("cycle_time_s: 0.1\nliveness_message: SPEED", "liveness_message belongs to sent_only_on_change"),
    ("sent_only_on_change: true\nliveness_message: DOORS", "which is only sent on change; name another message"),
    ("sent_only_on_change: true\nliveness_message: NONE", "has no message NONE")])
def test_what_does_not_go_together_is_refused(tmp_path, lines, words):
    with pytest.raises(ConnectionFailed, match=words):
        load_profile(written(tmp_path, lines))


def played(folder, lines, channels, speed=()):
    """A log with the state on these channels, and another message on those of speed, played to its end."""
    path, sent = folder / "bus.log", [(LOCK_ID, each) for each in channels] + [(SPEED_ID, each) for each in speed]
    path.write_text("".join(f"({1.7e9 + 0.1 * index + 0.01 * number:.6f}) can{channel} {can_id:X}#01000000\n"
                            for index in range(100) for number, (can_id, channel) in enumerate(sent)))
    car = LogCarLink(path, written(folder, lines if "cycle_time_s" in lines else f"cycle_time_s: 0.1\n{lines}"))
    car.connect()
    problems = set()
    for index in range(90):
        time_s = 50.0 + 0.1 * index
        assert car.observe(RobotStatus(index, 1, time_s, sent_s=time_s, steady_s=time_s)) == []
        problems.add(car.problem)
    return car, problems


def test_state_on_two_channels_without_a_name_is_a_problem(tmp_path):
    car, problems = played(tmp_path, "", (0, 1))
    assert any("comes on several channels of the log, channel 1 among them" in problem for problem in problems)
    assert "comes on several channels" in car.problem and car.refused.count == 0


def test_state_on_a_further_bus_that_is_named_is_told(tmp_path):
    car, problems = played(tmp_path, "buses: {body: car.dbc}", (0, 1))
    assert not any("channels" in problem for problem in problems) and car.problem == ""
    notice, = car.notices
    assert "comes on the bus of the state and on the bus body; that of the first one counts" in notice


@pytest.mark.parametrize("channels", [(0,), (1,), (3,)])
def test_state_on_one_channel_is_that_of_the_car(tmp_path, channels):
    car, _ = played(tmp_path, "", channels)
    assert (car.lock_state, car.problem, car.notices) == (LockState.LOCKED, "", ())


TWO_BUSES = "buses: {body: car.dbc, rear: car.dbc}"


@pytest.mark.parametrize("lines", [TWO_BUSES, f"{TWO_BUSES}\n{WHOLE_BUS}", f"{TWO_BUSES}\n{MESSAGE}"],
                         ids=["cyclic", "only on change", "only on change beside another"])
@pytest.mark.parametrize("speed", [(0,), (1,), (2, 3), ()])
@pytest.mark.parametrize(("channels", "words"), [
    ((1,), "comes only on the bus body, and .* channel 0 and the bus body is channel 1"),
    ((2,), "comes only on the bus rear, and .* channel 0 and the bus rear is channel 2"),
    ((1, 2), "comes only on the bus body"), ((3,), "comes only on channel 3 of the log, and .* is channel 0")])
def test_state_on_a_further_bus_only_is_a_problem_that_names_it(tmp_path, lines, speed, channels, words):
    car, _ = played(tmp_path, lines, channels, speed)
    assert re.search(rf"DOORS \(id 0x321\) {words}", car.problem)
    assert (car.lock_state, car.notices) == (LockState.UNKNOWN, ())


def test_message_of_life_on_a_further_bus_only_is_a_problem_that_names_it(tmp_path):
    car, _ = played(tmp_path, f"{TWO_BUSES}\n{MESSAGE}", (0,), speed=(1,))
    assert "Message SPEED (id 0x1A0) comes only on the bus body" in car.problem


@pytest.mark.parametrize("speed", [(0,), (1,), (2, 3), ()])
def test_state_on_the_first_bus_is_no_problem_whatever_the_others_carry(tmp_path, speed):
    car, problems = played(tmp_path, TWO_BUSES, (0,), speed)
    assert (car.lock_state, car.problem, car.notices) == (LockState.LOCKED, "", ())
    assert not any("comes only" in problem for problem in problems)


def test_missing_state_on_a_live_bus_names_the_bus_that_carries_it(tmp_path):
    watch = LockWatch(load_profile(written(tmp_path, f"cycle_time_s: 0.1\n{TWO_BUSES}")))
    for step in range(40):
        time_s = 10.0 + 0.1 * step
        watch.frame(CanFrame(SPEED_ID, False, bytes(4), time_s))
        watch.frame(CanFrame(LOCK_ID, False, b"\x01", time_s, bus="body"))
        watch.status(RobotStatus(step, 1, time_s, sent_s=time_s, steady_s=time_s), time_s)
        assert watch.release(time_s) == []
        assert time_s < 10.7 or "comes only on the bus body" in watch.problem
