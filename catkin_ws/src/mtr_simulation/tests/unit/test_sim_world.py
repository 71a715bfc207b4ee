"""Robot, firmware and Car work together, and their readings become the right messages."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math
import struct
from io import BytesIO

import numpy as np
import pytest
from sensor_msgs.msg import LaserScan

from mtr_core import names
from mtr_simulation import conversions
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.car import HonestCar
from mtr_simulation.car.slcan_port import Fault
from mtr_simulation.parameters import SimulatorParameters
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.world import World


@pytest.fixture
def world(tmp_path):
    made = World(SimulatorParameters(scenario="open", car_port_link=str(tmp_path / "can"), truth_dir=str(tmp_path)))
    yield made
    made.close()


def steps(world, count, lift_height_m=math.nan):
    """Step the world while the host commands the firmware every 100 ms."""
    for number in range(count):
        if number % 5 == 0:
            world.firmware.command(lift_height_m, 1)
        sensors = world.step()
    return sensors


def test_firmware_lifts_the_key(world):
    steps(world, 300, lift_height_m=0.5)
    assert world.truth.key_in_car[2] == pytest.approx(0.85, abs=0.01)


def test_press_reaches_the_truth_log(world, tmp_path):
    steps(world, 20)
    world.firmware.press(1, 2, 1.0, 300)
    steps(world, 50)
    with (tmp_path / "truth_events.csv").open() as lines:
        events = list(csv.DictReader(lines))
    assert [event["event"] for event in events][:1] == ["press"]
    assert float(events[0]["key_x_m"]) == pytest.approx(world.truth.key_in_car[0], abs=0.01)


def test_adapter_appears_and_goes_with_the_world(tmp_path):
    link = tmp_path / "can"
    world = World(SimulatorParameters(scenario="open", car_port_link=str(link)))
    assert link.is_symlink()
    world.close()
    assert not link.is_symlink()


def test_world_without_adapter_and_truth_runs():
    world = World(SimulatorParameters(scenario="open"))
    assert world.step().time_ns == 1_020_000_000
    world.equipment.request_handle(locks=False)
    world.close()


def test_car_sees_where_the_key_is_and_how_it_is_turned_and_hears_of_hands(tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(HonestCar, "step", lambda car, *arguments: seen.append(arguments))
    monkeypatch.setattr(HonestCar, "request_handle", lambda car, command: seen.append(command))
    world = World(SimulatorParameters(scenario="open", car="honest_handle", car_port_link=str(tmp_path / "can")))
    world.step()
    assert seen == [(world.truth.time_ns, world.truth.key_in_car, world.firmware.servo_us,
                     world.truth.car_from_base.heading)]
    world.equipment.request_handle(locks=False)
    world.equipment.request_handle(locks=True)
    assert seen[1:] == [Command.UNLOCK, Command.LOCK]
    world.close()


def test_scan_message_survives_the_wire(world):
    steps(world, 1)
    scan = world.step().front_scan
    wire = BytesIO()
    conversions.scan_message(scan, names.FRONT_LIDAR).serialize(wire)
    message = LaserScan().deserialize(wire.getvalue())
    assert np.array_equal(np.array(message.ranges, dtype=np.float32), scan.ranges_m)
    assert message.header.stamp.to_nsec() == scan.stamp_ns
    assert message.header.frame_id == names.FRONT_LIDAR
    assert message.angle_max == pytest.approx(math.radians(135.0), abs=1e-6)
    assert (message.time_increment, len(message.intensities)) == (pytest.approx(0.03 / 719), 0)


def test_odometry_and_imu_messages_have_units_and_frames(world):
    sensors = steps(world, 1)
    odometry = conversions.OdometryMessage(names.ODOM).fill(sensors.time_ns, sensors.odometry)
    imu = conversions.ImuMessage(ImuParameters()).fill(sensors.time_ns, sensors.imu)
    assert (odometry.header.frame_id, odometry.child_frame_id, imu.header.frame_id) == ("odom", "base_link", "imu")
    assert odometry.twist.covariance[35] == 0.03
    assert imu.orientation_covariance[0] == -1.0
    assert imu.linear_acceleration.z == sensors.imu.acceleration[2]


def test_truth_message_is_the_pose_in_the_car_frame(world):
    message = conversions.TruthMessage().fill(world.truth)
    yaw = 2.0 * math.atan2(message.pose.pose.orientation.z, message.pose.pose.orientation.w)
    assert (message.header.frame_id, message.child_frame_id) == ("car", "base_link")
    assert message.pose.pose.position.x == world.truth.car_from_base.x
    assert math.remainder(yaw - world.truth.car_from_base.heading, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-9)


def test_firmware_message_has_the_firmware_s_clock(world):
    steps(world, 5)
    wire = BytesIO()
    message = conversions.firmware_message(world.firmware.state())
    message.serialize(wire)
    assert struct.unpack_from("<I", wire.getvalue())[0] == 1_100_000
    assert message.servo_us == (1000, 1000)


def test_battery_message_says_how_much_is_left(world):
    sensors = steps(world, 1)
    assert conversions.battery_message(sensors.time_ns, sensors.battery).percentage == pytest.approx(0.95, abs=0.001)


@pytest.mark.parametrize("kind, fault", [("off", Fault.SILENCE), ("garbage", Fault.GARBAGE), ("stop", Fault.BUS_OFF)])
def test_injected_faults_of_the_hardware_are_there_until_they_are_gone(tmp_path, kind, fault):
    world = World(SimulatorParameters(scenario="open", car_port_link=str(tmp_path / "can")))
    world.equipment.set_faults({"can": kind, "lift": "stuck", "servos": "off", "imu": "off"})
    port, firmware = world.equipment._port, world.firmware
    assert port.fault is fault and firmware.lift_is_stuck and firmware.servos_are_dead
    world.equipment.set_faults({})
    assert port.fault is Fault.NONE and not (firmware.lift_is_stuck or firmware.servos_are_dead)
    world.close()


def test_ignition_and_speed_are_what_the_car_reports(tmp_path):
    world = World(SimulatorParameters(scenario="open", car_port_link=str(tmp_path / "can")))
    vehicle = world.equipment._car.vehicle
    world.equipment.set_ignition(True)
    for told, reported in ((7.5, 7.5), (-1.0, 0.0), (1e9, 650.0), (float("nan"), 650.0), (0.0, 0.0)):
        world.equipment.set_car_speed(told)
        assert (vehicle.ignition_on, vehicle.speed_kmh) == (True, reported)
    assert world.step()
    world.close()
