"""What was recorded as right and was wrong (facts of the defects B1 to B10, N4): now it is invalid, and says why.

The whole way from CAN frames to results: a kinematic robot, a Car with two radii, and the real watch of the locks.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, CarLink, LockFacts, LockState
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.robot_status import Interventions
from mtr_operator.domain.scenarios import SCENARIOS

FRAME_S, PHASE_S = 0.02, 0.007
SOURCES = {PASSIVE_ENTRY: 1, KEY_BUTTON: 2, "": 0}
AUTOLOCK, KEY_PRESS = SCENARIOS["autolock"], SCENARIOS["key_press"]
AXES = AUTOLOCK.parameters_type(measurements_distance_m=10.0, measuring_speed_mps=0.4, self_check=False)
RADIALS = KEY_PRESS.parameters_type(angle_between_radials_rad=math.pi / 2, self_check=False)
PLAIN = ("alive_signal", "command_signal", "changed_signal")


class WatchedCar(CarLink):
    """The world's Car on a bus of 20 ms: frames of its lock message go through the real watch.

    Attributes:
        spoil: data of a frame, from its time and its data. raw_source: raw value of a source.
    """

    def __init__(self, world, profile):
        self.world, self.profile, self.watch = world, profile, LockWatch(profile)
        self.message, self.past, self.frame_s = None, [], PHASE_S
        self.spoil, self.raw_source = lambda time_s, data: data, SOURCES.__getitem__

    def connect(self):
        pass

    def observe(self, status):
        self.message = self.message or DemoLockMessage(self.world.locked)
        self.past += sorted(self.world.events, key=lambda event: event.time_s)
        self.world.events = []
        self._send_until(status.stamp_s)
        self.watch.status(status, status.stamp_s)
        self._send_until(status.stamp_s + FRAME_S)
        return self.watch.release(status.stamp_s)

    def _send_until(self, time_s):
        while self.frame_s <= time_s:
            while self.past and self.past[0].time_s <= self.frame_s:
                event = self.past.pop(0)
                self.message.is_locked = event.lock_state is LockState.LOCKED
                self.message.source = self.raw_source(event.source)
            data = self.spoil(self.frame_s, self.message.next())
            self.watch.frame(CanFrame(0x320, False, data, self.frame_s, round(self.frame_s * 1000) % 60_000))
            self.frame_s = round(self.frame_s + FRAME_S, 6)

    @property
    def lock_state(self):
        return self.watch.lock_state

    @property
    def facts(self):
        return self.profile.facts

    @property
    def problem(self):
        return self.watch.problem

    def close(self):
        pass


def plain_profile(folder):
    """The demo car's profile without counters and flag."""
    lines = (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text(encoding="utf-8").splitlines()
    path = folder / "plain.yaml"
    path.write_text("\n".join(line for line in lines if not line.startswith(PLAIN)), encoding="utf-8")
    (folder / "mtr_demo_car.dbc").write_bytes((PROFILE_FOLDER / "mtr_demo_car.dbc").read_bytes())
    return load_profile(str(path))


@pytest.fixture(params=["demo", "plain"])
def profile(request, tmp_path):
    """With and without counters."""
    return load_profile("mtr_demo_car") if request.param == "demo" else plain_profile(tmp_path)


@pytest.fixture
def car_link(world, profile):
    """The world's Car on a bus, instead of one without frames."""
    return WatchedCar(world, profile)


@pytest.fixture
def radials_world(world):
    """World whose Car heeds buttons only."""
    world.unlock_m = world.lock_m = -1.0
    return world


def first_of(run_scenario):
    """The first line as it was measured first."""
    return run_scenario.saved[0][0]


def statuses(result):
    return [distance.status.value for distance in result.distances]


def test_undisturbed_lines_are_ok_and_say_how_the_key_was_carried(run_scenario, world):
    results = run_scenario(AUTOLOCK, AXES)
    assert [statuses(result) for result in results] == 8 * [["ok", "ok"]]
    for result in results:
        assert result.unlock_distance_m == pytest.approx(1.5, abs=0.012)
        assert result.lock_distance_m == pytest.approx(2.5, abs=0.012)
        assert (result.unlock_lateral_offset_m, result.unlock_heading_offset_deg) == pytest.approx((0.0, 0.0), abs=1e-6)
        assert (result.unlock_key_height_m, result.lock_key_height_m) == (1.0, 1.0)
        assert result.unlock_speed_mps == pytest.approx(0.4)
        assert (result.unlock_cause, result.lock_cause, result.evidence) == (PASSIVE_ENTRY, PASSIVE_ENTRY, ())


def test_undisturbed_radials_are_ok_and_say_how_the_key_was_carried(run_scenario, radials_world):
    results = run_scenario(KEY_PRESS, RADIALS)
    assert [(result.status.value, result.distance_m, result.cause) for result in results] == \
        4 * [("ok", pytest.approx(5.0), KEY_BUTTON)]
    assert {(result.key_height_m, result.speed_mps) for result in results} == {(1.0, 0.0)}


@pytest.mark.parametrize("raw", [2, 1])
@pytest.mark.parametrize("instant", range(10))
def test_glitch_of_one_frame_is_no_distance(run_scenario, world, car_link, raw, instant):  # B1, N4
    world.unlock_m = -1.0
    glitch_s = []

    def spoil(time_s, data):
        on_approach = world.waypoint and world.waypoint.id == 3 and world.speed_mps > 0.3
        if on_approach and not glitch_s:
            glitch_s.append(math.ceil(time_s / 0.1) * 0.1 + 0.3 + instant * FRAME_S + PHASE_S)
        is_glitch = glitch_s and abs(time_s - glitch_s[0]) < FRAME_S / 2
        return bytes([(data[0] & ~0x73) | 0x10 | raw]) + data[1:] if is_glitch else data

    car_link.spoil = spoil
    results = run_scenario(AUTOLOCK, AXES)
    assert statuses(first_of(run_scenario)) == ["invalid", "invalid"]
    assert "on its bus" in first_of(run_scenario).reason or "unknown value" in first_of(run_scenario).reason
    frames = first_of(run_scenario).evidence
    assert any(text.split("#")[1].startswith(f"1{raw}") for text in frames) and len(frames) > 5
    assert [statuses(result) for result in results] == 8 * [["not_reached", "not_reached"]]


@pytest.mark.parametrize("instant", range(5))
def test_glitch_of_one_frame_is_no_answer_to_a_press(run_scenario, radials_world, car_link, instant):  # N4
    world = radials_world
    world.press_range_m = 0.0
    glitch_s = []

    def spoil(time_s, data):
        if world.presses and not glitch_s:
            glitch_s.append(math.ceil(world.presses[0].start_s / 0.1) * 0.1 + 0.5 + instant * FRAME_S + PHASE_S)
        is_glitch = glitch_s and abs(time_s - glitch_s[0]) < FRAME_S / 2
        return bytes([(data[0] & ~0x73) | 0x21]) + data[1:] if is_glitch else data

    car_link.spoil = spoil
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials"):
        run_scenario(KEY_PRESS, RADIALS)
    assert first_of(run_scenario).status.value == "invalid"
    assert [result.status.value for result in run_scenario.progress.results] == [
        "invalid", "not_reached", "not_reached"]


@pytest.mark.parametrize("raw", [0, 3, 5, 7])
@pytest.mark.parametrize(("scenario", "parameters"), [(AUTOLOCK, AXES), (KEY_PRESS, RADIALS)])
def test_cause_that_the_profile_does_not_list_is_invalid(run_scenario, car_link, scenario, parameters,
                                                         raw):  # B2
    if scenario is KEY_PRESS:
        car_link.world.unlock_m = car_link.world.lock_m = -1.0
    car_link.raw_source = lambda source: raw
    results = run_scenario(scenario, parameters)
    assert {status for result in results for status in statuses(result)} == {"invalid"}
    assert "by something that its profile does not list" in results[0].reason


@pytest.mark.parametrize("source", ["", KEY_BUTTON])
@pytest.mark.parametrize(("relocked_s", "started_s"), [(0.2, 0.53), (1.0, 5.03)])
def test_change_between_order_and_press_is_no_answer(run_scenario, radials_world, source, relocked_s,
                                                     started_s):  # B3
    world = radials_world
    world.locked, world.press_range_m, world.press_delay_s = False, 0.0, started_s
    take = world.take

    def relock_after_the_order(desired):
        if desired.press is not None and not world.pressed:
            world.foreign = [(world.time_s + relocked_s, True, source)]
        take(desired)

    world.take = relock_after_the_order
    with pytest.raises(RobotFailed, match="answered nowhere on 3 radials"):
        run_scenario(KEY_PRESS, RADIALS)
    assert first_of(run_scenario).status.value == "invalid"
    assert "before the press at 6.00 m, by something else" in first_of(run_scenario).reason


@pytest.mark.parametrize("offset_m", [0.5, 1.0, 2.0, -0.2])
@pytest.mark.parametrize(("scenario", "parameters"), [(AUTOLOCK, AXES), (KEY_PRESS, RADIALS)])
def test_key_beside_the_line_is_invalid(run_scenario, world, scenario, parameters, offset_m):  # B5
    if scenario is KEY_PRESS:
        world.unlock_m = world.lock_m = -1.0
    world.spoil = lambda status: replace(status, x=status.x - offset_m * math.sin(status.heading),
                                         y=status.y + offset_m * math.cos(status.heading))
    results = run_scenario(scenario, parameters)
    assert {status for result in results for status in statuses(result)} == {"invalid"}
    assert f"{100 * abs(offset_m):.0f} cm beside the line; allowed are 10 cm" in results[0].reason


@pytest.mark.parametrize("turned_deg", [7.0, -20.0])
def test_robot_turned_from_the_line_is_invalid(run_scenario, world, turned_deg):  # B5
    def turn(status):
        # About the key, which stays on the line.
        key_x = status.x + status.key_x * math.cos(status.heading)
        key_y = status.y + status.key_x * math.sin(status.heading)
        heading = status.heading + math.radians(turned_deg)
        return replace(status, heading=heading, x=key_x - status.key_x * math.cos(heading),
                       y=key_y - status.key_x * math.sin(heading))

    world.spoil = turn
    results = run_scenario(AUTOLOCK, AXES)
    assert {status for result in results for status in statuses(result)} == {"invalid"}
    assert f"turned by {abs(turned_deg):.1f} degrees" in results[0].reason


@pytest.mark.parametrize("height_m", [1.5, 0.9, math.nan])
def test_key_at_another_height_during_a_line_is_invalid(run_scenario, world, height_m):  # B6
    world.spoil = lambda status: replace(status, key_height_m=height_m) \
        if world.waypoint and world.waypoint.id > 6 else status
    results = run_scenario(AUTOLOCK, AXES)
    assert statuses(results[0]) == ["ok", "ok"]
    assert {status for result in results[1:] for status in statuses(result)} == {"invalid"}
    assert "Remote key" in results[1].reason


@pytest.mark.parametrize("profile", ["demo"], indirect=True)
def test_repeated_last_frame_is_invalid_and_not_not_reached(run_scenario, world, car_link):  # B7
    last = []

    def freeze(time_s, data):
        if 8.5 <= time_s <= 13.0:
            last.append(data)
            return last[0]
        return data

    car_link.spoil = freeze
    results = run_scenario(AUTOLOCK, AXES)
    assert "invalid" in statuses(first_of(run_scenario))
    assert "AliveCounter of the Car's lock message" in first_of(run_scenario).reason
    # After half a second it counts as silent, and the next line waits for it.
    assert len([result for result in run_scenario.saved[-9] if "invalid" in statuses(result)]) <= 3
    assert [statuses(result) for result in results] == 8 * [["ok", "ok"]]


def test_relock_in_the_retreat_is_no_lock_distance(run_scenario, world):  # B10
    def relock_at_194(status):
        if not world.locked and world.waypoint.direction is Direction.BACKWARD and world.key()[0] > 2.25 + 1.94 \
                and world.waypoint.id == 4:
            world.foreign = [(world.time_s + 0.01, True, "")]
        return status

    world.spoil = relock_at_194
    run_scenario(AUTOLOCK, AXES)
    assert statuses(first_of(run_scenario)) == ["ok", "invalid"]
    assert "by something that its profile does not list" in first_of(run_scenario).reason


def test_late_reaction_to_each_press_is_invalid_and_says_so(run_scenario, radials_world):  # B10
    radials_world.reaction_s, radials_world.press_range_m = 3.4, 99.0
    run_scenario(KEY_PRESS, RADIALS)
    assert first_of(run_scenario).status.value == "invalid"
    assert "s too late for the press at" in first_of(run_scenario).reason


def test_unlocking_in_the_retreat_is_too_late_and_no_not_reached(run_scenario, world):  # B10
    def unlock_in_the_retreat(status):
        if world.locked and world.waypoint and world.waypoint.id == 4 and world.speed_mps > 0.3:
            world.foreign = [(world.time_s + 0.01, False, PASSIVE_ENTRY)]
        return status

    world.unlock_m, world.spoil = -1.0, unlock_in_the_retreat
    run_scenario(AUTOLOCK, AXES)
    assert statuses(first_of(run_scenario)) == ["invalid", "invalid"]
    assert "too late for the Remote key's vicinity" in first_of(run_scenario).reason


@pytest.mark.parametrize(("counter", "words"), [
    ("manual_drives", "driven by hand"), ("manual_lifts", "moved by hand"), ("replans", "planned its path anew"),
    ("blockages", "An obstacle"), ("lock_stops", "A motion lock"), ("firmware_resets", "The board"),
    ("clock_steps", "clock was set")])
def test_intervention_during_a_line_is_invalid_though_no_status_shows_it(run_scenario, world, counter, words):  # B5
    def intervene(status):
        happened = status.stamp_s > 8.0
        return replace(status, interventions=Interventions(**{counter: 4 + happened}))

    world.spoil = intervene
    results = run_scenario(AUTOLOCK, AXES)
    assert "invalid" in statuses(first_of(run_scenario)) and words in first_of(run_scenario).reason
    assert [statuses(result) for result in results] == 8 * [["ok", "ok"]]


@pytest.mark.parametrize("profile", ["demo"], indirect=True)
def test_lock_at_the_time_of_the_cars_own_timer_is_invalid(run_scenario, world, car_link, profile):  # B10
    # Without sources nobody can tell the timer from the key.
    car_link.profile = replace(profile, relock_after_s=3.0, sources={})
    car_link.watch = LockWatch(car_link.profile)
    run_scenario(AUTOLOCK, AXES)
    # From 1.5 m to 2.5 m at 0.4 m/s: 2.5 s after it was unlocked.
    assert statuses(first_of(run_scenario)) == ["ok", "invalid"]
    assert "when it locks by itself anyway" in first_of(run_scenario).reason


def test_relock_by_the_cars_own_timer_between_two_presses_is_explained(run_scenario, radials_world, car_link,
                                                                      profile):  # B3
    world = radials_world
    world.press_range_m = 5.2
    car_link.profile = replace(profile, relock_after_s=9.0)

    def relock(status):
        if not world.locked and not world.foreign:
            world.foreign = [(world.time_s + 8.95, True, "")]
        return status

    world.spoil = relock
    results = run_scenario(KEY_PRESS, RADIALS)
    assert all(result.status.value == "ok" or result.reason for result in results)
    assert results[0].status.value == "ok"


def test_car_without_sources_has_the_cause_unknown(run_scenario, world, car_link, profile):  # B2
    car_link.profile = replace(profile, sources={})
    car_link.watch = LockWatch(car_link.profile)
    assert car_link.facts.sources == LockFacts().sources
    results = run_scenario(AUTOLOCK, AXES)
    assert {(result.unlock_cause, result.lock_cause) for result in results} == {("unknown", "unknown")}
