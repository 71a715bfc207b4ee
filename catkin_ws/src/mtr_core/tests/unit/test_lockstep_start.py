"""Life cycle of a node: exit status and log."""
# SPDX-License-Identifier: Apache-2.0
import gc
from dataclasses import dataclass

import pytest
import rospy

from mtr_core.errors import RobotError
from mtr_core.lockstep import run_node
from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """One number."""

    speed_mps: float = number(0.5, 0.05, 2.0, "m/s")


class Node:
    """A node whose spin() ends as the test requires."""

    def __init__(self, parameters, end=None):
        self.parameters, self._end = parameters, end

    def spin(self):
        """Return at once, or raise the given error."""
        if self._end:
            raise self._end


@pytest.fixture
def printed(monkeypatch):
    """Return the lines of the log as (level, sentence), without a ROS master."""
    lines = []
    monkeypatch.setattr(rospy, "init_node", lambda name: None)
    monkeypatch.setattr(rospy, "get_param", lambda name, default: {})
    monkeypatch.setattr(rospy, "loginfo", lambda text, *values: lines.append(("info", text % values)))
    monkeypatch.setattr(rospy, "logfatal", lambda text, *values: lines.append(("fatal", text % values)))
    return lines


@pytest.fixture(autouse=True)
def master(monkeypatch):
    """Return the parameters on the master."""
    kept = {}
    monkeypatch.setattr(rospy, "get_name", lambda: "/walker")
    monkeypatch.setattr(rospy, "set_param", kept.__setitem__)
    monkeypatch.setattr(rospy, "has_param", kept.__contains__)
    monkeypatch.setattr(rospy, "delete_param", kept.__delitem__)
    yield kept
    # Objects that the node excluded from collection belong to the test process here.
    gc.unfreeze()


def test_why_a_node_cannot_start_is_kept_until_it_has_started(printed, master, monkeypatch):
    monkeypatch.setattr(rospy, "get_param", lambda name, default: {"speed_mps": 3.0})
    run_node("walker", Parameters, Node)
    assert master == {"/start_failures/walker": "Parameter speed_mps is 3 m/s; allowed is 0.05 to 2 m/s."}
    monkeypatch.setattr(rospy, "get_param", lambda name, default: {})
    run_node("walker", Parameters, Node)
    assert master == {}


def test_node_whose_master_is_gone_ends_all_the_same(printed, monkeypatch):
    def refuse(name, value):
        raise ConnectionRefusedError("master")
    monkeypatch.setattr(rospy, "set_param", refuse)
    monkeypatch.setattr(rospy, "get_param", lambda name, default: {"speed_mps": 3.0})
    assert run_node("walker", Parameters, Node) == 2


def test_node_prints_its_parameters_in_one_line_and_ends_with_0(printed):
    assert run_node("walker", Parameters, Node) == 0
    assert printed == [("info", "Parameters: speed_mps 0.5 m/s")]


def test_collections_of_garbage_do_not_look_at_what_was_there_at_the_start(printed):
    looked_at = []

    class Watcher(Node):
        def spin(self):
            looked_at.append((len(gc.get_objects()), gc.get_freeze_count()))

    assert run_node("walker", Parameters, Watcher) == 0
    ((now, spared),) = looked_at
    assert spared > 10_000 and now < 1_000


def test_wrong_parameter_ends_it_with_2_after_one_sentence(printed, monkeypatch):
    monkeypatch.setattr(rospy, "get_param", lambda name, default: {"speed_mps": 3.0})
    assert run_node("walker", Parameters, Node) == 2
    assert printed == [("fatal", "The node walker cannot start. Parameter speed_mps is 3 m/s; "
                                 "allowed is 0.05 to 2 m/s.")]


def test_node_that_cannot_be_made_ends_with_2(printed):
    def make(parameters):
        raise RobotError("The port is busy.")
    assert run_node("walker", Parameters, make) == 2
    assert printed[-1] == ("fatal", "The node walker cannot start. The port is busy.")


@pytest.mark.parametrize("end", [rospy.ROSInterruptException("sleep"), rospy.ROSException("publish")])
def test_shutdown_in_the_middle_of_work_ends_with_0(printed, monkeypatch, end):
    monkeypatch.setattr(rospy, "is_shutdown", lambda: True)
    assert run_node("walker", Parameters, lambda parameters: Node(parameters, end)) == 0


def test_error_while_running_is_not_swallowed(printed, monkeypatch):
    monkeypatch.setattr(rospy, "is_shutdown", lambda: False)
    with pytest.raises(rospy.ROSException):
        run_node("walker", Parameters, lambda parameters: Node(parameters, rospy.ROSException("broken")))
