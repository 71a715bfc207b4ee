"""Imports of the simulated surroundings, and fixtures of a world in which the Car was found."""
# SPDX-License-Identifier: Apache-2.0
import copy
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture(scope="session")
def located():
    """Return a world in which the Car, with bumpers and wheels, was found; shared, so it must not be changed."""
    from locator_simulation import Scene, World, car_with_bumpers

    from mtr_core.states import CarState
    running = World(Scene(car_with_bumpers()))
    assert running.run().state == CarState.LOCATED
    return running


@pytest.fixture
def world(located):
    """Return a separate world in which the Car has just been found."""
    return copy.deepcopy(located)
