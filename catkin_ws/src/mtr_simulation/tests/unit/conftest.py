"""Makes the bench of the honest Car importable by the tests beside it; benches, and a wall clock that a test sets."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture
def bench(tmp_path):
    """Makes a Car with some parameters changed."""
    from honest_bench import Bench, calm
    return lambda **sections: Bench(tmp_path, calm(**sections))


class WallClock:
    """Wall clock that jumps far ahead at each look when it is in a hurry."""

    def __init__(self):
        self.now_s = 0.0
        self.hurry_s = 0.0

    def __call__(self):
        self.now_s += self.hurry_s
        return self.now_s


@pytest.fixture
def clock():
    """It stands until a test sets it."""
    return WallClock()
