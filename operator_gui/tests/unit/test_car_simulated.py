"""The Car inside the application: plausible areas, the same again for the same seed. Numbers are of defects."""
# SPDX-License-Identifier: Apache-2.0
import csv
import dataclasses
import itertools
import math
import random

import pytest

from mtr_operator.car_link.simulated_car import LOCK_M, PRESS_M, UNLOCK_M, SimulatedCarLink
from mtr_operator.cli import commands, main
from mtr_operator.cli.arguments import argument_parser
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import CarDimensions, PressReport, RobotStatus
from mtr_operator.station.connection import SIMULATED, CanChoice, LinkOpener

CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)


def status(number, x, y=0.0, **changes):
    """The robot at a place with the key at its middle; ten times a second."""
    return RobotStatus(number, 1, 0.1 * number, x=x, y=y, heading=0.0, pose_valid=True, car=CAR, **changes)


@pytest.fixture
def car():
    link = SimulatedCarLink(1)
    link.connect()
    return link


def drive(car, places, first=1):
    """Events while the key is at these distances before the front bumper."""
    return [event for number, gap in enumerate(places, first) for event in car.observe(status(number, 2.25 + gap))]


def approach_and_retreat():
    way = [4.0 - 0.03 * step for step in range(110)]
    return way + way[::-1]


def test_car_unlocks_near_it_and_locks_farther_away_and_at_no_other_place__B16(car):
    places = approach_and_retreat()
    events = drive(car, places)
    assert [event.lock_state for event in events] == [LockState.UNLOCKED, LockState.LOCKED]
    unlocked, locked = (places[round(event.time_s / 0.1) - 1] for event in events)
    assert unlocked == pytest.approx(UNLOCK_M, rel=0.3) and locked == pytest.approx(LOCK_M, rel=0.3)


def test_press_of_the_calibration_leaves_passive_entry_to_the_test_that_follows__B16(car):
    def events(first, session):
        return [event for number, gap in enumerate(approach_and_retreat(), first)
                for event in car.observe(status(number, 2.25 + gap, session_id=session))]
    car.observe(status(1, 4.0, session_id=1, presses=(PressReport(1, 0.05, 0.1, "", ()),)))
    car.observe(status(2, 4.0, session_id=1, presses=(PressReport(2, 0.15, 0.2, "", ()),)))
    assert car.lock_state is LockState.LOCKED and events(3, session=1) == []
    assert [event.lock_state for event in events(1000, session=2)] == [LockState.UNLOCKED, LockState.LOCKED]


def test_events_come_in_order_and_never_from_the_future(car):
    stamps = [0.0]
    for number, gap in enumerate(approach_and_retreat(), 1):
        for event in car.observe(status(number, 2.25 + gap)):
            assert stamps[-1] < event.time_s <= 0.1 * number + 1e-9
            stamps.append(event.time_s)
    assert len(stamps) == 3


def test_same_seed_gives_the_same_events_and_another_one_others():
    def events(seed):
        link = SimulatedCarLink(seed)
        link.connect()
        return drive(link, approach_and_retreat())
    assert events(1) == events(1)
    assert len({tuple(event.time_s for event in events(seed)) for seed in range(1, 6)}) > 1


def press_at(car, number, distance_m):
    return car.observe(status(number, distance_m, presses=(PressReport(number, 0.1 * number, 0.1 * number + 0.05),)))


@pytest.mark.parametrize(("distance_m", "works"), [(0.7 * PRESS_M, True), (1.3 * PRESS_M, False)])
def test_press_works_near_the_car_and_not_far_away(car, distance_m, works):
    answers = [bool(press_at(car, number, distance_m)) for number in range(1, 200)]
    assert sum(answers) == pytest.approx(197 if works else 0, abs=3)


def test_car_reacts_to_a_robot_whose_clock_began_anew(car):
    near = 0.7 * PRESS_M
    for number in range(5000, 5050):
        press_at(car, number, near)
    drive(car, approach_and_retreat(), 5100)
    again = [car.observe(dataclasses.replace(status(number, near, presses=(PressReport(
        number, 0.1 * number, 0.1 * number + 0.05),)), robot_session_id=2)) for number in range(1, 50)]
    assert sum(map(bool, again)) == pytest.approx(48, abs=3)
    events = [event for number, gap in enumerate(approach_and_retreat(), 50) for event in car.observe(
        dataclasses.replace(status(number, 2.25 + gap, session_id=7), robot_session_id=3))]
    assert len(events) == 2


def test_passive_entry_rests_once_a_button_was_pressed(car):
    press_at(car, 1, 3.0 * PRESS_M)
    assert drive(car, approach_and_retreat(), 2) == []


def test_hand_at_the_handle_unlocks_with_the_key_near_only(car):
    found = []
    for number, gap in enumerate(itertools.chain([3.0] * 5, [0.5] * 5), 1):
        if car.lock_state is LockState.LOCKED:
            car.handle.request(gap)
        found += [gap for _ in car.observe(status(number, 2.25 + gap))]
    assert found == [0.5]


def test_nothing_happens_before_the_car_is_mapped_or_connected(car):
    lost = [RobotStatus(number, 1, 0.1 * number, x=2.5, y=0.0, heading=0.0, pose_valid=False) for number in range(20)]
    assert [event for each in lost for event in car.observe(each)] == []
    assert SimulatedCarLink().observe(status(1, 2.5)) == []
    assert SimulatedCarLink().lock_state is LockState.UNKNOWN and SimulatedCarLink().problem


def test_window_has_the_same_simulated_car__B16():
    assert isinstance(LinkOpener().car(CanChoice(SIMULATED)), SimulatedCarLink)


def rows_of(folder):
    lines = (folder / "results.csv").read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def test_demo_needs_no_file_and_shows_plausible_areas__B16(tmp_path, capsys):
    assert main(["demo", "--out", str(tmp_path / "out")]) == 0
    rows = rows_of(tmp_path / "out")
    assert len(rows) == 28 and {row["unlock_status"] for row in rows} == {row["lock_status"] for row in rows} == {"ok"}
    unlock, lock = ([float(row[f"{word}_distance_m"]) for row in rows] for word in ("unlock", "lock"))
    assert all(near + 0.3 < far for near, far in zip(unlock, lock))
    # Neighbours differ by little, and opposite sides by more: an area, and no noise.
    steps = [abs(one - other) for one, other in zip(unlock, [*unlock[1:], unlock[0]])]
    assert max(steps) < 0.35 and max(unlock) - min(unlock) > 0.1
    assert (tmp_path / "out" / "protocol.png").exists()
    assert "all sides" in capsys.readouterr().out


def test_demo_of_presses_is_the_search_that_the_window_proposes__B16(tmp_path):
    assert main(["demo", "key_press", "--out", str(tmp_path / "out")]) == 0
    rows = rows_of(tmp_path / "out")
    assert {row["method"] for row in rows} == {"adaptive"}
    measured = [row for row in rows if row["status"] == "ok"]
    assert len(measured) >= 7
    assert all(float(row["d50_m"]) == pytest.approx(PRESS_M, rel=0.25) for row in measured)


def test_demo_without_a_folder_writes_into_that_of_the_results(tmp_path, monkeypatch):
    made = []
    monkeypatch.setattr(commands, "CommandLineRun", lambda options: made.append(options.out) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(["demo"])
    assert made[0].parent.name == "results" and made[0].name.startswith("demo_autolock_")
    assert not made[0].exists()


@pytest.mark.parametrize(("sleep_s", "rest", "is_heard"), [(0.0, 100, True), (5.0, 30, True), (5.0, 60, False)])
def test_key_at_rest_sleeps_and_its_button_works_all_the_same(sleep_s, rest, is_heard):
    car = SimulatedCarLink(1, sleep_s)
    car.connect()
    # Far away, where nothing unlocks, then at the Car, asked there; 0.1 s each.
    drive(car, [0.3])
    car.handle.request(0.3)
    drive(car, [0.3], first=2)
    car.handle.release()
    assert car.lock_state is LockState.UNLOCKED
    car.observe(status(3, 2.55, presses=(PressReport(1, 0.25, 0.3, "", ()),)))
    assert car.lock_state is LockState.LOCKED
    drive(car, [0.4, *(rest * [0.3])], first=4)
    car.handle.request(0.3)
    drive(car, [0.3], first=rest + 5)
    assert (car.lock_state is LockState.UNLOCKED) is is_heard
    number = rest + 6
    car.observe(status(number, 2.55, presses=(PressReport(2, 0.1 * number - 0.05, 0.1 * number, "", ()),)))
    assert (car.lock_state is LockState.UNLOCKED) is not is_heard


def test_sleep_of_the_simulated_key_beyond_its_range_is_one_sentence(tmp_path, capsys):
    (tmp_path / "parameters.yaml").write_text("side: left\n", encoding="utf-8")
    assert main(["run", "sleep_time", "--params", str(tmp_path / "parameters.yaml"), "--out", str(tmp_path / "out"),
                 "--simulated-robot", "--simulated-car", "--simulated-key-sleep", "-3"]) == 2
    assert "the simulated key sleeps is -3 s; allowed is 0 to 3600 s." in capsys.readouterr().err


@pytest.mark.parametrize(("reach_m", "is_on", "is_heard"), [(0.0, True, False), (3.0, False, False), (3.0, True, True)])
def test_extender_has_the_key_be_nearer_while_it_is_switched_on(reach_m, is_on, is_heard):
    car = SimulatedCarLink(1, extender_m=reach_m)
    car.connect()
    car.extender.switch(True)
    car.extender.switch(is_on)
    assert car.extender.is_switched()
    car.extender.release()
    assert not car.extender.is_switched()
    drive(car, [3.0])
    car.handle.request(3.0)
    drive(car, [3.0], first=2)
    assert (car.lock_state is LockState.UNLOCKED) is is_heard


def test_reach_of_the_extender_beyond_its_range_is_refused():
    with pytest.raises(InvalidParameter, match="reach of the simulated extender is 101 m; allowed is 0 to 100 m"):
        SimulatedCarLink(1, extender_m=101.0)


def reaches(seed, car_seed):
    """Where the Car reacts around it, without chance."""
    link = SimulatedCarLink(seed, car_seed=car_seed)
    return [link._part((math.cos(bearing), math.sin(bearing))) for bearing in (0.0, 1.0, 2.0, 3.0)]


def test_another_seed_is_another_test_at_the_same_car_and_another_car_seed_another_car():
    assert reaches(101, 1) == reaches(102, 1) == reaches(1, 1)
    assert reaches(1, 2) != reaches(1, 1)

    def presses(seed):
        link = SimulatedCarLink(seed)
        link.connect()
        return tuple(bool(press_at(link, number, PRESS_M)) for number in range(1, 20))
    assert presses(101) != presses(102)


def test_first_car_and_seed_give_the_figures_of_before():
    link = SimulatedCarLink(1)
    chance = random.Random(1)
    assert [phase for _, _, phase in link._lobes] == [chance.uniform(0.0, 2.0 * math.pi) for _ in link._lobes]
    assert link._chance.random() == chance.random()


@pytest.mark.parametrize("command", [["demo"], ["run", "autolock", "--params", "p.yaml", "--out", "out"],
                                     ["try", "mtr_demo_car"], ["window"]])
def test_car_seed_can_be_chosen_wherever_the_substitute_of_the_car_can(command):
    assert argument_parser().parse_args([*command, "--car-seed", "7"]).car_seed == 7
    # The window has a default of its own.
    assert argument_parser().parse_args(command).car_seed == (None if command == ["window"] else 1)


def test_window_opens_with_the_car_that_is_chosen():
    ranges = [LinkOpener(car_seed=car_seed).car(CanChoice(SIMULATED))._lobes for car_seed in (1, 7)]
    assert ranges == [SimulatedCarLink()._lobes, SimulatedCarLink(car_seed=7)._lobes]
