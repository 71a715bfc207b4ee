"""Fixtures: import path of `honest_bench`, benches of honest Cars, and a wall clock that a test sets."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture
def bench(tmp_path):
    """Function that makes a bench whose Car has the given parameters changed."""
    from honest_bench import Bench, calm
    return lambda **sections: Bench(tmp_path, calm(**sections))


class WallClock:
    """Wall clock that advances by `hurry_s` each time it is read."""

    def __init__(self):
        self.now_s = 0.0
        self.hurry_s = 0.0

    def __call__(self):
        self.now_s += self.hurry_s
        return self.now_s


@pytest.fixture
def clock():
    """Wall clock that stays constant until a test sets it."""
    return WallClock()
