"""Makes the helpers of this folder importable, and provides state machines in each of their states."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import pytest

from mtr_core.states import State
from mtr_state_machine.core import StateMachine
from mtr_state_machine.parameters import Parameters

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from state_machine_seen import COLLECTING, LOCATED, ORDERS_CHECK, seen


@pytest.fixture
def machine():
    """A state machine without holds (test_state_machine_hold.py) and signals (test_state_machine_signal.py)."""
    return StateMachine(Parameters(resume_by_operator=False, signal_s=0.0))


@pytest.fixture
def mapping(machine):
    machine.step(seen(car=COLLECTING))
    assert machine.state is State.MAPPING_CAR
    return machine


@pytest.fixture
def following(mapping):
    mapping.step(seen(car=LOCATED))
    assert mapping.state is State.FOLLOWING_WAYPOINT
    return mapping


@pytest.fixture
def checking(following):
    following.step(seen(car=LOCATED, desired=ORDERS_CHECK))
    assert following.state is State.CHECKING_CAR
    return following
