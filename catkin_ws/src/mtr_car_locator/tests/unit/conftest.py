"""Makes the simulated surroundings importable by the tests beside them, and has a world in which the Car was found."""
# SPDX-License-Identifier: Apache-2.0
import copy
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture(scope="session")
def located():
    """A world in which the Car, with bumpers and wheels, was found; not to be changed."""
    from locator_simulation import Scene, World, car_with_bumpers

    from mtr_core.states import CarState
    running = World(Scene(car_with_bumpers()))
    assert running.run().state == CarState.LOCATED
    return running


@pytest.fixture
def world(located):
    """A world of its own in which the Car has just been found."""
    return copy.deepcopy(located)
