"""Base parameters, nodes that did not start, clock and network."""
# SPDX-License-Identifier: Apache-2.0
import copy

import pytest

from mtr_commissioning.preflight.base import base_findings, parameter_findings, start_findings
from mtr_commissioning.preflight.clocks import clock_finding, masters_finding, network_findings
from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.records import RobotRecord
from mtr_description.base_controller import base_parameters_in
from mtr_description.shipped import shipped_base, shipped_base_file

ROBOT, SIMULATION = Setup(), Setup(is_simulated=True)
TRACKING = "A29FC801,192.168.1.7,3,1700000000.1,{offset},-0.000001,0.00002,-12.3,0.001,0.05,0.012,0.0005,64.2,{leap}\n"


def base_texts(values, setup=ROBOT):
    """Return subjects and sentences of bad findings."""
    findings = base_findings(RobotRecord(base=values), setup, shipped_base())
    return [(finding.subject, finding.text) for finding in findings if finding.is_bad]


def changed(path, value):
    """Return the shipped parameters with one changed, or removed if the value is None."""
    values = copy.deepcopy(base_parameters_in(shipped_base_file()))
    *groups, name = path.split("/")
    inner = values
    for group in groups:
        inner = inner[group]
    inner.pop(name) if value is None else inner.update({name: value})
    return values


def test_shipped_base_is_good():
    assert base_texts(base_parameters_in(shipped_base_file())) == []


@pytest.mark.parametrize("path, value", [
    ("cmd_vel_timeout", None), ("cmd_vel_timeout", 0.5), ("cmd_vel_timeout", 0.0), ("cmd_vel_timeout", True),
    ("linear/x/max_acceleration", 20.0), ("linear/x/max_acceleration", None), ("angular/z/max_acceleration", 25.0)])
def test_number_that_is_missing_or_beyond_is_named_with_the_file_to_load(path, value):
    found = base_texts(changed(path, value))
    assert [subject for subject, _ in found] == [f"/jackal_velocity_controller/{path}"]
    assert "jackal_base.yaml" in found[0][1]


@pytest.mark.parametrize("path, value", [("linear/x/has_acceleration_limits", False),
                                         ("angular/z/has_acceleration_limits", None),
                                         ("linear/x/has_jerk_limits", True)])
def test_switch_that_lets_the_mast_tip_is_bad(path, value):
    found = base_texts(changed(path, value))
    assert len(found) == 1 and path.rpartition("/")[2] in found[0][1]


def test_base_without_parameters_is_bad_on_a_robot_and_said_in_simulation():
    assert base_texts(None) and not base_texts(None, SIMULATION)


def test_parameters_of_the_base_guard_are_its_own():
    assert Setup(base_guard=True).base_parameters == "/base_guard/jackal_velocity_controller"
    assert Setup(base_controller="/husky").base_parameters == "/husky"


def test_node_that_did_not_start_is_told_with_its_own_sentence():
    found = start_findings(RobotRecord(start_failures={"drive_control": "Parameter x is 3; allowed is 1 to 2."}))
    assert found[0].line() == "BAD drive_control: It cannot start. Parameter x is 3; allowed is 1 to 2."
    assert start_findings(RobotRecord()) == []


def test_parameters_of_a_node_that_does_not_run_are_bad():
    named = {"drive_contrl": {}, "drive_control": {}, "base": {}, "localization": {}}
    record = RobotRecord(nodes=frozenset({"drive_control", "base/controller"}), node_parameters=named,
                         start_failures={"localization": "Because."})
    assert [finding.subject for finding in parameter_findings(record) if finding.is_bad] == ["drive_contrl"]


@pytest.mark.parametrize("topics, text", [
    (("/e_stop", "/b"), "Drive control listens to the emergency stops /e_stop, /b."),
    ((), "Drive control listens to no emergency stop on a topic of its own.")])
def test_emergency_stops_on_topics_are_said(topics, text):
    found = parameter_findings(RobotRecord(e_stop_topics=topics))
    assert [finding.line() for finding in found] == [f"ok  e_stop_topics: {text}"]


@pytest.mark.parametrize("offset, leap, is_bad", [
    ("0.000012", "Normal", False), ("-0.0199", "Normal", False), ("0.021", "Normal", True), ("-3600.0", "Normal", True),
    ("0.000012", "Not synchronised", True)])
def test_offset_beyond_20_ms_or_without_source_is_bad(offset, leap, is_bad):
    assert clock_finding(TRACKING.format(offset=offset, leap=leap), False).is_bad is is_bad


def test_offset_is_said_with_its_source():
    text = clock_finding(TRACKING.format(offset="-3600.0", leap="Normal"), False).text
    assert text.startswith("It is -3600000.0 ms off 192.168.1.7, allowed is 20 ms")


@pytest.mark.parametrize("output", [None, "", "506 Cannot talk to daemon\n"])
def test_robot_without_chrony_is_bad_and_a_simulation_is_not(output):
    assert clock_finding(output, False).is_bad and not clock_finding(output, True).is_bad


def test_robot_whose_clock_is_the_source_of_its_own_wifi_is_right():
    # Output of chronyc 4.3 for a chronyd with `local stratum 10` and no source.
    output = "7F7F0101,,10,1764115200.1,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,Normal\n"
    found = clock_finding(output, False)
    assert not found.is_bad
    assert found.text == "It follows no other and is offered to the laptops, as in a Wi-Fi of the robot's own."


@pytest.mark.parametrize("uri, environment, is_bad", [
    ("http://127.0.0.1:11311", {}, False), ("http://localhost:11311", {}, False),
    ("http://192.168.1.2:11311", {}, True), ("http://192.168.1.2:11311", {"ROS_IP": "192.168.1.9"}, False),
    ("http://robot:11311", {"ROS_HOSTNAME": "laptop"}, False)])
def test_master_elsewhere_is_said_and_needs_a_name_of_this_computer(uri, environment, is_bad):
    found = network_findings(environment, uri)
    assert [finding.is_bad for finding in found] == [is_bad] and uri in found[0].text


def test_second_master_on_the_robot_is_told_with_its_port_and_what_to_do():
    uri = "http://127.0.0.1:11311"
    assert not masters_finding(uri, [11311], False).is_bad
    found = masters_finding(uri, [11311, 11321], False)
    assert found.is_bad and found.text.startswith("2 run on this computer, allowed is 1: beside http://127.0.0.1:11311 "
                                                  "one on port 11321, whose nodes")
    assert found.text.endswith("with the same ROS_MASTER_URI, the base's first.")
    assert not masters_finding(uri, [11311, 11321], True).is_bad
