"""MuJoCo model of the robot: base with four wheels, two LiDARs, mast, lift and key.

Geoms of group 2 belong to the robot; its own LiDARs do not see them. Collision classes: obstacles 1/1, ground 8/0,
chassis 0/9, tyres 0/1, because the ground carries the tyres by the explicit tyre model and not by contacts.
"""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.se2 import Pose2
from mtr_description.mounts import Mount

from .robot import WHEELS, Box, RobotModel, Vector

SHELL = 'group="2" contype="0" conaffinity="9" friction="0.3"'
# Gain of the wheel servos; with a stronger servo, or an implicit integrator, the base runs faster than its wheels turn.
WHEEL_SERVO_NMS = 5.0
WHEEL_ARMATURE_KGM2 = 0.05
LIFT_STIFFNESS_NPM = 4000.0


def robot_body(robot: RobotModel, world_from_base: Pose2) -> str:
    """Return body base_link on a free joint."""
    pose, base = world_from_base, robot.base
    return f"""
    <body name="base_link" pos="{pose.x:.9f} {pose.y:.9f} {robot.base_height_m:.6f}" euler="0 0 {pose.heading:.9f}">
      <freejoint name="root"/>
      <inertial pos="{_plain(*base.centre)}" mass="{base.mass_kg}"
        fullinertia="{_plain(*base.inertia_kgm2)}"/>
      {"".join(_box(f"chassis_{index}", box) for index, box in enumerate(robot.chassis))}
      {_lidar(robot, robot.front_lidar)}
      {_lidar(robot, robot.rear_lidar) if robot.rear_lidar else ""}
      {_mast(robot)}
      {"".join(_wheel(robot, name, position) for name, position in zip(WHEELS, robot.wheel_positions))}
    </body>"""


def robot_actuators(max_wheel_torque_nm: float) -> str:
    """Return speed servos of the wheels, then the position servo of the lift."""
    wheels = "".join(f'<velocity name="{name}" joint="{name}" kv="{WHEEL_SERVO_NMS}" '
                     f'forcerange="-{max_wheel_torque_nm} {max_wheel_torque_nm}"/>' for name in WHEELS)
    return f'{wheels}<position name="lift" joint="lift" kp="{LIFT_STIFFNESS_NPM}" forcerange="-300 300"/>'


def _vector(*values: float) -> str:
    return " ".join(f"{value:.6f}" for value in values)


def _plain(*values: float) -> str:
    return " ".join(f"{value:g}" for value in values)


def _box(name: str, box: Box) -> str:
    half = _vector(*(side / 2.0 for side in box.size))
    return f'<geom name="{name}" type="box" pos="{_vector(*box.centre)}" size="{half}" {SHELL}/>'


def _lidar(robot: RobotModel, mount: Mount) -> str:
    radius, height = robot.lidar_size
    return (f'<body name="{mount.frame}" pos="{_vector(*mount.position)}">'
            f'<geom type="cylinder" size="{radius} {height / 2.0}" mass="{robot.lidar_mass_kg}" {SHELL}/></body>')


def _mast(robot: RobotModel) -> str:
    return f"""
      <body name="mast" pos="{_vector(*robot.mast_foot)}">
        {_heavy_box("mast", robot.mast, robot.mast_mass_kg)}
        <body name="carriage" pos="{_vector(0.0, 0.0, robot.carriage_z_m)}">
          <joint name="lift" type="slide" axis="0 0 1" range="0 {robot.key.lift_travel_m}" damping="200" armature="2"/>
          {_heavy_box("arm", robot.arm, robot.carriage_mass_kg)}
          {_heavy_box("key", _key_on_carriage(robot), robot.key_mass_kg)}
        </body>
      </body>"""


def _key_on_carriage(robot: RobotModel) -> Box:
    x, y, z = robot.key_box.centre
    ahead_m, aside_m = robot.key.x_m - robot.mast_foot[0], robot.key.y_m - robot.mast_foot[1]
    return Box((x + ahead_m, y + aside_m, z), robot.key_box.size)


def _heavy_box(name: str, box: Box, mass_kg: float) -> str:
    half = " ".join(str(side / 2.0) for side in box.size)
    return (f'<geom name="{name}" type="box" pos="{_plain(*box.centre)}" size="{half}" mass="{mass_kg}" '
            f'{SHELL}/>')


def _wheel(robot: RobotModel, name: str, position: Vector) -> str:
    return f"""
      <body name="{name}_wheel" pos="{_vector(*position)}">
        <inertial pos="0 0 0" mass="{robot.wheel.mass_kg}" diaginertia="{_plain(*robot.wheel.inertia_kgm2[:3])}"/>
        <joint name="{name}" type="hinge" axis="0 1 0" damping="0.02" armature="{WHEEL_ARMATURE_KGM2}"/>
        <geom name="{name}_tyre" type="cylinder" size="{robot.wheel_radius_m} {robot.wheel_width_m / 2.0}"
          euler="1.5707963268 0 0" group="2" contype="0" conaffinity="1"/>
      </body>"""
