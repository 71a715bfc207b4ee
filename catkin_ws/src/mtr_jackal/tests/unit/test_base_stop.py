"""The hardware stop of a Jackal: pressed, absent, silent, never received or unreadable, it locks the robot."""
# SPDX-License-Identifier: Apache-2.0
import io
import math
import pathlib

import genpy.dynamic
import pytest
import roslaunch

from mtr_jackal import node as shell
from mtr_jackal.judge import ABSENT, NEVER_RECEIVED, PRESSED, SILENT, UNREADABLE, BaseStop, StopReport
from mtr_jackal.node import STOP, StatusDecoder
from mtr_jackal.parameters import Parameters

LAUNCH = pathlib.Path(__file__).resolve().parents[5] / "launch" / "launch" / "jackal.launch"
SILENT_AFTER_S = Parameters().silent_after_s
RELEASED, ENGAGED, NONE = StopReport(True, False), StopReport(True, True), StopReport(False, False)
# The fields of a base's status around those that matter; the publisher sends the definition with the connection.
DEFINITION = """Header header
string hardware_id
duration mcu_uptime
bool drivers_active
bool driver_external_stop_present
bool driver_external_stop_stopped
float32 measured_battery
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""
TYPE = "jackal_msgs/Status"


def header(definition=DEFINITION, name=TYPE, md5sum="1"):
    return {"type": name, "message_definition": definition, "md5sum": md5sum}


def status(**fields):
    """Return the bytes of a status."""
    message = genpy.dynamic.generate_dynamic(TYPE, DEFINITION)[TYPE]()
    message.hardware_id = "J100-0001"
    for field, value in fields.items():
        setattr(message, field, value)
    data = io.BytesIO()
    message.serialize(data)
    return data.getvalue()


@pytest.mark.parametrize("report, reason", [(RELEASED, ""), (ENGAGED, PRESSED), (NONE, ABSENT),
                                            (StopReport(False, True), PRESSED), (None, UNREADABLE)])
def test_stop_counts_as_engaged_unless_it_is_present_and_released(report, reason):
    stop = BaseStop(SILENT_AFTER_S)
    stop.receive(report, 10.0)
    assert stop.reason(10.0) == reason


def test_stop_that_was_never_received_is_engaged():
    assert BaseStop(SILENT_AFTER_S).reason(0.0) == NEVER_RECEIVED
    assert BaseStop(SILENT_AFTER_S).reason(1e9) == NEVER_RECEIVED


@pytest.mark.parametrize("age_s, reason", [(0.0, ""), (1.0, ""), (SILENT_AFTER_S - 0.01, ""),
                                           (SILENT_AFTER_S + 0.01, SILENT), (1e9, SILENT), (-3.0, SILENT),
                                           (math.nan, SILENT)])
def test_silent_stop_is_engaged_until_it_is_received_again(age_s, reason):
    stop = BaseStop(SILENT_AFTER_S)
    stop.receive(RELEASED, 10.0)
    assert stop.reason(10.0 + age_s) == reason
    stop.receive(RELEASED, 1e9 + 20.0)
    assert not stop.reason(1e9 + 20.0)


@pytest.mark.parametrize("present", [False, True])
@pytest.mark.parametrize("stopped", [False, True])
def test_status_is_decoded_without_the_package_of_its_messages(present, stopped):
    data = status(driver_external_stop_present=present, driver_external_stop_stopped=stopped, measured_battery=27.5)
    assert StatusDecoder().report(header(), data) == StopReport(present, stopped)


@pytest.mark.parametrize("given, data", [
    (header("float32 measured_battery\n"), b"\0\0\0\0"), (header(), status()[:9]), (header("nonsense nonsense x"), b""),
    ({}, b""), (header("uint8 driver_external_stop_present\nuint8 driver_external_stop_stopped\n"), b"\1\0")],
    ids=["other fields", "cut off", "no definition", "no header", "other types"])
def test_message_that_does_not_contain_the_stop_is_unreadable(given, data, monkeypatch):
    logged = []
    monkeypatch.setattr(shell.rospy, "logwarn_throttle", lambda period_s, text, error: logged.append(text))
    assert StatusDecoder().report(given, data) is None


def started(*arguments):
    return roslaunch.config.load_config_default([(str(LAUNCH), list(arguments))], None)


def test_jackal_relays_its_hardware_stop_unless_a_person_chose_otherwise():
    config = started()
    assert config.params["/drive_control/e_stop_topics"].value == [STOP]
    assert [node.type for node in config.nodes if node.name == "base_stop"] == ["base_stop"]
    both = started("stop_input:=true")
    assert both.params["/drive_control/e_stop_topics"].value == [STOP, "/peripherals/stop_input"]
    chain = started("stop_input:=true", "base_stop:=false")
    assert chain.params["/drive_control/e_stop_topics"].value == ["/peripherals/stop_input"]
    without = started("base_stop:=false")
    assert "/drive_control/e_stop_topics" not in without.params
    assert not [node for node in without.nodes if node.name == "base_stop"]
