"""Restart of a locator with a stored Car."""
# SPDX-License-Identifier: Apache-2.0
import copy
import json

import numpy as np
import pytest
from locator_simulation import Scene, World, car_with_bumpers

from mtr_car_locator.locator import CarLocator
from mtr_car_locator.memory.keeper import CarKeeper
from mtr_car_locator.memory.memory_file import MemoryFile
from mtr_car_locator.memory.remembered import MemoryUnusable, RememberedCar, plain, remembered_from
from mtr_car_locator.scan import RangeBias
from mtr_core.executors import InlineExecutor
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check

CAR = car_with_bumpers()


def remembered(estimate):
    car = RememberedCar(estimate.fit, estimate.map_revision, estimate.revision, estimate.map_car_id)
    # Round trip through a file.
    return remembered_from(json.loads(json.dumps(plain(car))))


def start_anew(world):
    world.locator = CarLocator(world.scene.parameters, remembered(world.newest))


def test_a_file_brings_the_same_car(world):
    before, after = world.newest.fit, remembered(world.newest).fit
    assert (after.rectangle, after.outline, after.sigmas, after.seen) == (
        before.rectangle, before.outline, before.sigmas, before.seen)
    assert (after.in_plane, after.quality, after.by_wheels, after.warning, after.range_bias) == (
        before.in_plane, before.quality, before.by_wheels, before.warning, before.range_bias)
    for name in ("position", "normal", "length", "sigma", "hits"):
        np.testing.assert_array_equal(getattr(after.surfels, name), getattr(before.surfels, name))


def test_a_locator_that_is_started_again_has_the_same_car_at_once(world):
    before = world.newest
    start_anew(world)
    after = world.stand(0.5)
    assert (after.state, after.revision, after.map_car_id) == (CarState.LOCATED, before.revision, before.map_car_id)
    assert after.rectangle == before.rectangle and after.map_revision == before.map_revision


def test_it_checks_the_car_under_numbers_that_no_place_has_had(world):
    world.check(3)
    used = {estimate.waypoint.id for estimate in world.estimates if estimate.waypoint}
    start_anew(world)
    world.estimates.clear()
    world.stand(0.2)
    assert world.check(4).check.state is Check.PASSED
    assert used.isdisjoint({estimate.waypoint.id for estimate in world.estimates if estimate.waypoint})


def test_a_car_that_was_moved_meanwhile_is_noticed(world):
    start_anew(world)
    world.place_car(world.car @ Pose2(0.5, 0.0, 0.0), CAR)
    after = world.stand(15.0)
    assert after.state == CarState.FAILED and "The Car was moved, by" in after.message.text


@pytest.fixture(scope="module")
def biased():
    """Return a world with 15 mm range bias, in which the Car was found; shared, so it must not be changed."""
    running = World(Scene(CAR, range_bias=RangeBias(0.015, 0.015), pose_sigma_m=0.002))
    assert running.run().state == CarState.LOCATED
    return running


def test_a_range_bias_is_remembered_and_is_no_motion_of_the_car(biased):
    world = copy.deepcopy(biased)
    start_anew(world)
    assert world.newest.fit.range_bias == RangeBias(0.015, 0.015)
    assert world.stand(15.0).revision == 1
    assert world.check(3).check.difference_m < 0.005


def test_a_file_of_before_the_bias_was_kept_is_read_and_the_bias_changes_nothing(biased):
    world = copy.deepcopy(biased)
    data = json.loads(json.dumps(plain(RememberedCar(world.newest.fit, world.newest.map_revision, 1, 7))))
    del data["fit"]["range_bias"]
    car = remembered_from(data)
    assert car.fit.range_bias == (0.0, 0.0, 0.03)
    world.locator = CarLocator(world.scene.parameters, car)
    assert world.stand(15.0).revision == 1


def test_a_map_of_another_number_is_another_map(world):
    start_anew(world)
    world.mapper.revision += 1
    assert world.stand(0.5).state == CarState.FAILED


def test_an_order_to_map_begins_anew(world):
    start_anew(world)
    world.step(mapping=True, map_car_id=8)
    for _ in range(10):
        world.step(mapping=True, map_car_id=8)
    assert world.newest.state == CarState.COLLECTING


@pytest.mark.parametrize("damage", [
    lambda data: data.pop("fit"), lambda data: data["fit"].pop("rectangle"), lambda data: data.update(revision="x"),
    lambda data: data["fit"].update(surfels=[[1.0, 2.0]]), lambda data: data["fit"].update(unknown=1),
    lambda data: data["fit"].update(range_bias=["x"])])
def test_a_damaged_car_is_a_sentence(world, damage):
    data = json.loads(json.dumps(plain(RememberedCar(world.newest.fit, 1, 1, 7))))
    damage(data)
    with pytest.raises(MemoryUnusable, match="The remembered Car is damaged"):
        remembered_from(data)


def test_file_is_read_in_the_run_that_wrote_it_only(tmp_path):
    path = tmp_path / "folder" / "car.json"
    MemoryFile(path, "run 1").write({"revision": 3})
    assert MemoryFile(path, "run 1").read()["revision"] == 3
    assert MemoryFile(path, "run 2").read() is None
    MemoryFile(path, "run 1").write(None)
    assert not path.exists() and MemoryFile(path, "run 1").read() is None
    MemoryFile(path, "run 1").write(None)


def test_torn_file_and_folder_that_is_none_are_sentences(tmp_path):
    path = tmp_path / "car.json"
    path.write_text('{"run_id": "run 1", "fi', encoding="utf-8")
    with pytest.raises(MemoryUnusable, match="cannot be read"):
        MemoryFile(path, "run 1").read()
    with pytest.raises(MemoryUnusable, match="cannot be written .* mapped again"):
        MemoryFile(path / "below", "run 1").write({})


def frame_of(car):
    return car.fit.rectangle, car.revision, car.map_car_id, car.map_revision


class Kept:
    """Keeper with an immediate disk, and its log."""

    def __init__(self, path, run_id="run 1"):
        self.said = []
        self.keeper = CarKeeper(MemoryFile(path, run_id), InlineExecutor(), self.said.append)


def test_keeper_writes_each_frame_once_and_forgets_a_car_that_is_lost(world, tmp_path):
    path = tmp_path / "car.json"
    kept = Kept(path)
    kept.keeper.note(world.newest)
    written = path.stat().st_mtime_ns
    kept.keeper.note(world.stand(0.2))
    assert path.stat().st_mtime_ns == written
    assert frame_of(Kept(path).keeper.read()) == frame_of(remembered(world.newest))
    moved = world.car @ Pose2(0.15, 0.0, 0.0)
    world.place_car(moved, CAR)
    kept.keeper.note(world.stand(15.0))
    assert world.newest.state == CarState.FAILED and not path.exists() and not kept.said


def test_keeper_says_what_it_goes_on_with_and_what_it_cannot(world, tmp_path):
    path = tmp_path / "car.json"
    Kept(path).keeper.note(world.newest)
    again = Kept(path)
    again.keeper.read()
    assert again.said == ["The Car locator was started anew; it goes on with the Car of before, revision 1."]
    path.write_text("{", encoding="utf-8")
    torn = Kept(path)
    assert torn.keeper.read() is None and "cannot be read" in torn.said[0]
    nowhere = Kept(path / "below")
    nowhere.keeper.note(world.newest)
    assert "cannot be written" in nowhere.said[0]
    assert CarKeeper(None, InlineExecutor(), pytest.fail).read() is None
