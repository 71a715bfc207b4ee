"""A line that was interrupted in its retreat is finished with its point, or measured anew; no point is lost (C1)."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.requests import Direction
from mtr_operator.domain.results.journal import LINE, LINE_BEGUN, LINE_RESUMED, POINT, SUPERSEDED
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarCheck, CarFrame, CheckState
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import load_progress
from mtr_operator.storage.store import Store

SCENARIO = SCENARIOS["autolock"]
PARAMETERS = SCENARIO.parameters_type.from_mapping({"measurements_distance_m": 10.0, "measuring_speed_mps": 0.4})
INTERRUPTED = 2
ENDS = (LINE, SUPERSEDED, LINE_BEGUN, LINE_RESUMED)


class Actions(RunObserver):
    """What was done; raises at the retreat of a line, as Ctrl-C would."""

    def __init__(self, last=None):
        self.said, self._last = [], last

    def on_action(self, text):
        self.said.append(text)
        if self._last and text.startswith("retreat") and any(f"axis {self._last} " in said for said in self.said):
            raise Cancelled("The test was interrupted.")


class Laptop:
    """Runs the test on the world's links; kinds and values of the journal's entries are in `entries`."""

    def __init__(self, path, robot_link, car_link):
        self.path, self.links, self.entries = path, (robot_link, car_link), []
        self.progress = Progress("autolock", PARAMETERS.to_mapping())

    def run(self, last=None):
        actions = Actions(last)
        with Store(self.path, self.progress) as store:
            add = store.add
            store.add = lambda kind, values: (self.entries.append((kind, values)), add(kind, values))
            loop = ControlLoop(*self.links, actions)
            Runner(SCENARIO, PARAMETERS, loop, self.progress, lambda _: store.save(), journal=store).run()
        return actions.said

    def reload(self):
        """As after a kill."""
        self.progress = load_progress(self.path.with_suffix(".journal"), SCENARIO, PARAMETERS.to_mapping())

    def points(self, number):
        """Points of a line, over all that was done."""
        lines = [index for index, (kind, values) in enumerate(self.entries)
                 if kind in (LINE_BEGUN, LINE_RESUMED) and values["line"] == number]
        ends = [next((end for end in range(start + 1, len(self.entries)) if self.entries[end][0] in ENDS),
                     len(self.entries)) for start in lines]
        return [values for start, end in zip(lines, ends) for kind, values in self.entries[start:end] if kind == POINT]

    def result(self, number):
        return next(result for result in self.progress.results if result.number == number)


@pytest.fixture
def laptop(tmp_path, robot_link, car_link):
    """After an interruption in the retreat of a line."""
    made = Laptop(tmp_path / "progress.json", robot_link, car_link)
    with pytest.raises(Cancelled):
        made.run(last=INTERRUPTED)
    return made


@pytest.mark.parametrize("killed", [False, True])
def test_line_goes_on_with_the_retreat_and_its_point_counts_once(laptop, killed):
    if killed:
        laptop.reload()
    said = laptop.run()
    result = laptop.result(INTERRUPTED)
    assert (result.unlock_status.value, result.lock_status.value) == ("ok", "ok")
    assert result.lock_distance_m == pytest.approx(2.5, abs=0.05)
    assert [point["word"] for point in laptop.points(INTERRUPTED)] == ["unlock", "lock"]
    assert result.unlock_robot_time_s == pytest.approx(laptop.points(INTERRUPTED)[0]["distance"]["robot_time_s"])
    assert not any(text.startswith(f"axis {INTERRUPTED} ") for text in said)
    assert len(laptop.progress.results) == 8 and not laptop.progress.retried


@pytest.mark.parametrize("rolled_m", [0.4, -0.4])
def test_robot_that_rolled_on_brings_the_key_back_to_where_the_car_unlocked(laptop, world, robot_link, rolled_m):
    point, = laptop.points(INTERRUPTED)
    world.x -= rolled_m * math.cos(world.heading)
    world.y -= rolled_m * math.sin(world.heading)
    begun = len(robot_link.answers)
    laptop.run()
    waypoints = {desired.waypoint.id: desired.waypoint for _, desired in reversed(robot_link.answers[begun:])
                 if desired.waypoint is not None}
    axis = laptop.result(INTERRUPTED).ray
    first, second = (waypoints[number] for number in (1, 2))
    if rolled_m > 0.0:
        assert first.direction is Direction.FORWARD
        assert axis.distance_of((first.pose.x, first.pose.y)) - 0.25 == pytest.approx(point["distance"]["distance_m"])
        first = second
    # What follows, and what a robot that rolled nearer begins with, is the retreat.
    assert first.direction is Direction.BACKWARD
    assert axis.distance_of((first.pose.x, first.pose.y)) - 0.25 == pytest.approx(PARAMETERS.straightened_distance_m)


class StandingRobot:
    """Stands somewhere on an axis on which the Car has unlocked."""

    now_s = 10.0

    def __init__(self, distance_m, lateral_m, heading_rad):
        self._place = Distance(distance_m, 0.03, 10.0, lateral_m, heading_rad)

    def kept(self, word):
        return self._place if word == "unlock" else None

    def trouble(self):
        return ""

    def key_distance(self, _ray, _time_s, _time_sigma_s):
        return self._place


# From 1 m nearer than the approach goes, by which a robot without its application may roll on, to the retreat's end.
@pytest.mark.parametrize(("place", "can_go_on"), [
    ((1.5, 0.0, 0.0), True),
    ((-0.5, 0.0, 0.0), True), ((-0.51, 0.0, 0.0), False),
    ((3.5, 0.0, 0.0), True), ((3.51, 0.0, 0.0), False),
    ((1.5, 0.1, 0.0), True), ((1.5, 0.101, 0.0), False), ((1.5, -0.1, 0.0), True), ((1.5, -0.101, 0.0), False),
    ((1.5, 0.0, math.radians(5.0)), True), ((1.5, 0.0, math.radians(-5.1)), False)])
def test_line_goes_on_from_any_place_of_its_axis_within_the_tolerances(world, car_link, place, can_go_on):
    world.locked = False
    line = SCENARIO.lines(PARAMETERS, world.car)[0]
    assert SCENARIO.can_go_on(line, PARAMETERS, StandingRobot(*place), Car(ControlLoop(None, car_link))) is can_go_on


def lock_the_car(world):
    world.locked = True


def drive_away(world):
    world.x += 1.0


def turn_round(world):
    world.heading += 1.0


def correct_the_frame(world):
    world.frame = CarFrame(2, 0.03)


def declare_a_timer(world):
    world.facts = replace(world.facts, relock_after_s=30.0)


@pytest.mark.parametrize("change", [lock_the_car, drive_away, turn_round, correct_the_frame, declare_a_timer])
def test_line_is_measured_anew_when_anything_has_changed_and_its_first_point_is_kept(laptop, world, change):
    first, = laptop.points(INTERRUPTED)
    laptop.reload()
    change(world)
    said = laptop.run()
    assert any(text.startswith(f"axis {INTERRUPTED} ") for text in said)
    kinds = [kind for kind, _ in laptop.entries]
    assert kinds.count(SUPERSEDED) == 1 and kinds.count(LINE_RESUMED) == 0
    assert laptop.points(INTERRUPTED)[0] == first
    result = laptop.result(INTERRUPTED)
    assert result.unlock_status.value == "ok"
    assert result.unlock_robot_time_s > first["distance"]["robot_time_s"]


def test_line_of_which_only_the_end_was_not_kept_needs_no_robot(laptop):
    point, = laptop.points(INTERRUPTED)
    laptop.reload()
    lock = {**point, "word": "lock", "distance": {**point["distance"], "distance_m": 2.45}}
    with Store(laptop.path, laptop.progress) as store:
        store.add(POINT, lock)
    laptop.reload()
    said = laptop.run()
    assert said.count("retreat until the Car locks") == 6
    assert laptop.result(INTERRUPTED).lock_distance_m == 2.45


def test_line_finished_before_a_check_that_fails_does_not_count(laptop, world):
    laptop.reload()
    world.check = CarCheck(1, CheckState.FAILED, 0.3, 0.0, 0.1, 0.1, "The Car stands elsewhere.")
    with pytest.raises(RobotFailed):
        laptop.run()
    assert INTERRUPTED not in laptop.progress.measured()
    assert set(laptop.progress.points) == {"unlock", "lock"}


def test_line_finished_before_a_check_that_corrects_the_frame_stays_in_its_own(laptop, world):
    laptop.reload()
    world.check = CarCheck(1, CheckState.PASSED, 0.03, 0.0, 0.1, 0.1)

    def correct(status):
        if world.checked_id:
            correct_the_frame(world)
        return status
    world.spoil = correct
    laptop.run()
    record = laptop.progress.frame_record
    assert [record.frames[record.lines[str(number)]].revision for number in (1, INTERRUPTED, 3)] == [0, 0, 2]
