"""Shutdown of a measurement's ROS node."""
# SPDX-License-Identifier: Apache-2.0
import pytest
import rospy

from mtr_benchmarks.harness.ros_shutdown import shut_down


def test_the_rospy_of_debian_11_does_not_end_a_measurement_before_its_figures_are_out(monkeypatch):
    said = []

    def stumbles(reason):
        said.append(reason)
        raise AttributeError("'Thread' object has no attribute 'isAlive'")

    monkeypatch.setattr(rospy, "signal_shutdown", stumbles)
    shut_down("The run is over.")
    assert said == ["The run is over."]


def test_other_defects_are_told(monkeypatch):
    def fails(reason):
        raise RuntimeError(reason)

    monkeypatch.setattr(rospy, "signal_shutdown", fails)
    with pytest.raises(RuntimeError):
        shut_down("The run is over.")
