"""Fits in another process: arguments and results survive the transfer."""
# SPDX-License-Identifier: Apache-2.0
import pickle
from concurrent.futures import Executor, Future

from locator_simulation import Scene, World, car_with_bumpers

from mtr_car_locator.find.errors import NotLocated
from mtr_car_locator.find.fit import rough_car
from mtr_car_locator.locator import CarLocator
from mtr_car_locator.survey import survey
from mtr_core.states import CarState


class PicklingExecutor(Executor):
    """Executor that works with pickled copies, as another process does."""

    def __init__(self):
        self.functions = []

    def submit(self, fn, *args, **kwargs):
        done = Future()
        fn, args, kwargs = pickle.loads(pickle.dumps((fn, args, kwargs)))
        self.functions.append(fn)
        try:
            done.set_result(pickle.loads(pickle.dumps(fn(*args, **kwargs))))
        except NotLocated as error:
            done.set_exception(pickle.loads(pickle.dumps(error)))
        return done


def mapped(scene, fits=None):
    """Return the world after the survey."""
    world = World(scene)
    world.locator = CarLocator(scene.parameters, fits=fits)
    world.run()
    return world


def test_all_fits_are_made_there_and_the_car_is_the_same():
    fits = PicklingExecutor()
    here, there = mapped(Scene(car_with_bumpers())).newest, mapped(Scene(car_with_bumpers()), fits).newest
    assert there.state is CarState.LOCATED
    assert (there.rectangle, there.sigmas, there.outline) == (here.rectangle, here.sigmas, here.outline)
    assert fits.functions.count(rough_car) > 4 and fits.functions[-1] is survey._fit_to_map
