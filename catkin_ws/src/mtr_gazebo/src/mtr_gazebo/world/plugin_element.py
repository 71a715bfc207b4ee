"""Plugin element: poses and sizes from the URDF, sensor errors from the parameters of the other simulator."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict
from xml.etree.ElementTree import Element

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_description.mounts import Mount
from mtr_description.robot_geometry import RobotGeometry
from mtr_simulation.physics.wheels import BaseParameters
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sensors.readings import ODOMETRY_VARIANCES

from .elements import Value, add
from .rigid_links import seen_from
from .timing import SensorTiming

PLUGIN = "libmtr_gazebo_plugin_ros.so"


def add_plugin(model: Element, seed: int, world_from_car: Pose2, timing: SensorTiming) -> Element:
    """Add the plugin to the robot's model; sensors and wheels are added to it later."""
    plugin = add(model, "plugin", name="robot", filename=PLUGIN)
    car = world_from_car
    _add_all(plugin, {"seed": seed, "world_from_car": (car.x, car.y, car.heading),
                      "clock_period_ms": timing.clock_period_ms, "truth_period_ms": timing.truth_period_ms})
    return plugin


def add_lidars(plugin: Element, geometry: RobotGeometry, has_rear: bool, lidar: LidarParameters,
               timing: SensorTiming) -> None:
    """Add the front LiDAR and the optional rear LiDAR."""
    _add_lidar(plugin, geometry.mount(names.FRONT_LIDAR), names.FRONT_SCAN, lidar,
               {"period_ms": timing.front_lidar_period_ms, "phase_ms": timing.front_lidar_phase_ms})
    if has_rear:
        _add_lidar(plugin, geometry.mount(names.REAR_LIDAR), names.REAR_SCAN, lidar,
                   {"period_ms": timing.rear_lidar_period_ms, "phase_ms": timing.rear_lidar_phase_ms})


def add_imu(plugin: Element, geometry: RobotGeometry, imu: ImuParameters, timing: SensorTiming) -> None:
    """Add the IMU."""
    mount = geometry.mount(names.IMU)
    _add_all(add(plugin, "imu"), {
        "frame": mount.frame, "topic": names.IMU_DATA, "pose": _pose(mount), "period_ms": timing.imu_period_ms,
        "phase_ms": timing.imu_phase_ms, "gyro_density": imu.gyro_density, "gyro_bias_radps": imu.gyro_bias_radps,
        "gyro_bias_walk": imu.gyro_bias_walk, "gyro_scale_error": imu.gyro_scale_error,
        "accelerometer_density": imu.accelerometer_density, "accelerometer_bias_mps2": imu.accelerometer_bias_mps2,
        "accelerometer_bias_walk": imu.accelerometer_bias_walk})


def add_base(plugin: Element, geometry: RobotGeometry, base: BaseParameters, timing: SensorTiming) -> None:
    """Add the wheels, their control, and their odometry."""
    wheels = geometry.wheels()
    element = add(plugin, "base")
    for joint in (each for each in geometry.tree.joints if each.type == "continuous"):
        side = "left" if geometry.tree.place(joint.child).position[1] > 0.0 else "right"
        add(element, f"{side}_joint", joint.name)
    _add_all(element, {
        "command_topic": names.WHEEL_COMMAND, "odometry_topic": names.WHEEL_ODOMETRY,
        "period_ms": timing.odometry_period_ms, "phase_ms": timing.odometry_phase_ms,
        # Wheel geometry as assumed by the base, with its errors.
        "believed_radius_m": wheels.radius_m * (1.0 + base.radius_error),
        "believed_half_track_m": 0.5 * wheels.track_m * base.separation_multiplier,
        "encoder_ticks_per_m": base.encoder_ticks_per_m, "max_linear_mps": base.max_linear_mps,
        "max_angular_radps": base.max_angular_radps, "max_linear_mps2": base.max_linear_mps2,
        "max_angular_radps2": base.max_angular_radps2, "command_timeout_s": base.command_timeout_s,
        "odometry_variances": ODOMETRY_VARIANCES, "max_wheel_torque_nm": base.max_wheel_torque_nm})


def add_lift(plugin: Element, geometry: RobotGeometry) -> None:
    """Add the lift's joint, and the pose of the key on the lifted link."""
    tree = geometry.tree
    lift = next(joint for joint in tree.chain(names.KEY) if joint.type == "prismatic")
    key = seen_from(tree.place(lift.child), tree.place(names.KEY))
    _add_all(add(plugin, "lift"), {
        "joint": lift.name, "link": lift.child, "key": [float(value) for value in key.position],
        "height_topic": names.SIM_LIFT, "max_force_n": float(lift.limit.effort)})


def _add_lidar(plugin: Element, mount: Mount, topic: str, lidar: LidarParameters, times: Dict[str, Value]) -> None:
    _add_all(add(plugin, "lidar"), {
        "frame": mount.frame, "topic": topic, "pose": _pose(mount), **times, "beams": lidar.beams,
        "field_of_view_rad": lidar.field_of_view_rad, "range_min_m": lidar.range_min_m,
        "range_max_m": lidar.range_max_m, "noise_m": lidar.noise_m})


def _pose(mount: Mount) -> Value:
    return (*mount.position, mount.roll_rad, mount.pitch_rad, mount.yaw_rad)


def _add_all(element: Element, values: Dict[str, Value]) -> None:
    for name, value in values.items():
        add(element, name, value)
