"""Messages that the node receives between two ticks."""
# SPDX-License-Identifier: Apache-2.0
from types import SimpleNamespace

import pytest

from mtr_core import names
from mtr_msgs.msg import MotionLock
from mtr_state_machine import node
from mtr_state_machine.observation import Emergency
from mtr_state_machine.parameters import Parameters


@pytest.fixture
def lock(monkeypatch):
    """Return a function that sends a motion lock to the node and returns its state of the emergency stops."""
    callbacks = {}
    for name in ("TickInput", "publisher", "Ticker", "PublisherWatch"):
        monkeypatch.setattr(node, name, lambda *_, **__: None)
    monkeypatch.setattr(node, "rospy", SimpleNamespace(
        Subscriber=lambda topic, kind, callback, **_: callbacks.__setitem__(topic, callback),
        get_name=lambda: "/state_machine"))
    made = node.StateMachineNode(Parameters())

    def take(owner, engaged, emergency):
        callbacks[names.MOTION_LOCK](MotionLock(owner=owner, engaged=engaged, emergency=emergency))
        return made._emergency.now()

    return take


def test_emergency_stop_between_two_ticks_is_known_and_another_lock_is_none(lock):
    assert lock("dispatcher", True, False) == Emergency()
    assert lock("/e_stop", True, True) == Emergency(is_engaged=True, stops=1)
    assert lock("/e_stop", False, True) == Emergency(is_engaged=False, stops=1)
