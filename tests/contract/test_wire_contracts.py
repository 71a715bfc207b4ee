"""Promises to the outside: field numbers, result columns, the Car's database on both sides."""
# SPDX-License-Identifier: Apache-2.0
import filecmp
import pathlib

import pytest

from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import LockState
from mtr_proto import robot_link_pb2
from mtr_simulation.car.choice import car_names, chosen_car

TOP = pathlib.Path(__file__).resolve().parents[2]
SIMULATED_CARS = TOP / "catkin_ws/src/mtr_simulation/src/mtr_simulation/car"
PROFILES = TOP / "operator_gui/src/mtr_operator/car_link/profiles"

# The thesis' listing 4.8; names in lower_snake_case.
ROBOT_STATE = {
    "x": (1, "float"), "y": (2, "float"), "heading": (3, "float"), "speed": (4, "float"),
    "device_height": (5, "float"), "pressed_device_buttons": (6, "uint32"),
    "localization_accuracy": (7, "int32"), "battery_level": (8, "uint32"), "is_mapping_car": (9, "bool"),
}
COMMAND = {
    "session_id": 1, "id": 2, "sent_time_s": 3, "seen_status_id": 4, "seen_robot_time_s": 5, "stop": 6, "waypoint": 7,
    "max_speed_mps": 8, "device_height_m": 9, "press": 10, "map_car_id": 11, "end_session": 12,
    "check_car_id": 13, "resume_hold_id": 14, "watches": 15, "test_area": 16,
    "enter_service": 17, "leave_service_id": 18,
}
STATUS = {
    "id": 1, "robot_session_id": 2, "sent_time_s": 3, "state": 4, "car": 5, "mode": 6, "session_id": 7,
    "command_id": 8, "waypoint_id": 9, "waypoint_result": 10, "waypoint_message": 11, "presses": 12, "map_car_id": 13,
    "log": 14, "notifications": 15, "rejected_messages": 16, "software_version": 17,
    "car_check": 18, "waypoint_problems": 19, "steady_time_s": 20, "interventions": 21, "emergency_stop": 22,
    "motion_source": 23, "hold_id": 24, "controller_name": 25, "surroundings": 26,
    "preflight": 27, "waits_for_answer": 28, "simulated": 29, "test_area": 30, "service_mode": 31,
}
TEST_AREA = {"id": 1, "origin_id": 2, "x": 3, "y": 4}
TEST_AREA_STATE = {
    "required": 1, "fixed": 2, "area": 3, "origin_id": 4, "x": 5, "y": 6, "heading": 7, "car_x": 8, "car_y": 9,
    "car_heading": 10, "problems": 11,
}
PREFLIGHT = {"made_s": 1, "items": 2, "checks": 3, "bad": 4}
PREFLIGHT_ITEM = {"name": 1, "level": 2, "sentence": 3}
TYPE_NAMES = {2: "float", 5: "int32", 8: "bool", 13: "uint32"}


def test_robot_state_keeps_the_numbers_and_types_of_the_thesis():
    fields = robot_link_pb2.RobotState.DESCRIPTOR.fields_by_name
    assert {name: (fields[name].number, TYPE_NAMES[fields[name].type]) for name in ROBOT_STATE} == ROBOT_STATE


def test_messages_keep_their_field_numbers():
    for message, promised in ((robot_link_pb2.Command, COMMAND), (robot_link_pb2.Status, STATUS),
                              (robot_link_pb2.TestArea, TEST_AREA),
                              (robot_link_pb2.TestAreaState, TEST_AREA_STATE),
                              (robot_link_pb2.PreflightReport, PREFLIGHT),
                              (robot_link_pb2.PreflightItem, PREFLIGHT_ITEM)):
        fields = message.DESCRIPTOR.fields_by_name
        assert {name: fields[name].number for name in promised} == promised


def test_schema_is_proto2_so_that_every_field_has_presence():
    assert (TOP / "proto" / "robot_link.proto").read_text(encoding="utf-8").count('syntax = "proto2";') == 1


@pytest.mark.parametrize("simulated", sorted(SIMULATED_CARS.rglob("*.dbc")), ids=lambda path: path.stem)
def test_simulated_car_and_application_use_the_same_database(simulated):
    profiles = list(PROFILES.rglob(simulated.name))
    assert len(profiles) == 1
    assert filecmp.cmp(simulated, profiles[0], shallow=False)


@pytest.mark.parametrize("name", car_names())
def test_profile_of_a_simulated_car_tells_how_its_bus_speaks(name):
    car = chosen_car(name)
    profile = load_profile(car.profile)
    assert set(profile.states.values()) == {LockState.LOCKED, LockState.UNLOCKED, LockState.UNKNOWN}
    if car.honest is not None:
        bus = car.honest.bus
        assert profile.cycle_time_s * 1000.0 == pytest.approx(bus.lock_cycle_ms)
        assert profile.sent_on_change is bus.sent_on_change
        assert bool(profile.sources) is (bus.cause_in == "same")
        assert bool(profile.command_signal) is bus.event_counter
        assert profile.relock_after_s == pytest.approx(car.honest.locks.relock_s)
