"""MuJoCo model of the robot: base with four wheels, two LiDARs, mast, lift and key.

Geoms of group 2 belong to the robot; its own LiDARs do not see them. Collision classes: obstacles 1/1, ground 8/0,
chassis 0/9, tyres 0/1, because the ground carries the tyres by the explicit tyre model and not by contacts.
"""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.se2 import Pose2

from . import robot

SHELL = 'group="2" contype="0" conaffinity="9" friction="0.3"'
# A stronger servo, or an implicit integrator, lets the base run faster than its wheels turn.
WHEEL_SERVO_NMS = 5.0
WHEEL_ARMATURE_KGM2 = 0.05
LIFT_STIFFNESS_NPM = 4000.0


def robot_body(world_from_base: Pose2) -> str:
    """Body base_link on a free joint."""
    pose = world_from_base
    return f"""
    <body name="base_link" pos="{pose.x:.9f} {pose.y:.9f} {robot.BASE_HEIGHT_M:.6f}" euler="0 0 {pose.heading:.9f}">
      <freejoint name="root"/>
      <inertial pos="0.012 0.002 0.067" mass="{robot.BASE_MASS_KG}"
        fullinertia="0.3136 0.3922 0.4485 -0.0008 0.0164 -0.0009"/>
      {_box("chassis", robot.CHASSIS_CENTRE, robot.CHASSIS_SIZE)}
      {_box("fenders", robot.FENDERS_CENTRE, robot.FENDERS_SIZE)}
      {_lidar("front_lidar", robot.FRONT_LIDAR_X_M)}
      {_lidar("rear_lidar", robot.REAR_LIDAR_X_M)}
      {_mast()}
      {"".join(_wheel(name, position) for name, position in zip(robot.WHEELS, robot.WHEEL_POSITIONS))}
    </body>"""


def robot_actuators(max_wheel_torque_nm: float) -> str:
    """Speed servos of the wheels, then the position servo of the lift."""
    wheels = "".join(f'<velocity name="{name}" joint="{name}" kv="{WHEEL_SERVO_NMS}" '
                     f'forcerange="-{max_wheel_torque_nm} {max_wheel_torque_nm}"/>' for name in robot.WHEELS)
    return f'{wheels}<position name="lift" joint="lift" kp="{LIFT_STIFFNESS_NPM}" forcerange="-300 300"/>'


def _vector(*values: float) -> str:
    return " ".join(f"{value:.6f}" for value in values)


def _box(name: str, centre: robot.Vector, size: robot.Vector) -> str:
    half = _vector(*(side / 2.0 for side in size))
    return f'<geom name="{name}" type="box" pos="{_vector(*centre)}" size="{half}" {SHELL}/>'


def _lidar(name: str, x_m: float) -> str:
    height = robot.LIDAR_HEIGHT_M - robot.BASE_HEIGHT_M
    return (f'<body name="{name}" pos="{_vector(x_m, 0.0, height)}">'
            f'<geom type="cylinder" size="0.05 0.04" mass="{robot.LIDAR_MASS_KG}" {SHELL}/></body>')


def _mast() -> str:
    half = robot.MAST_LENGTH_M / 2.0
    foot = robot.CHASSIS_SIZE[2]
    reach = robot.KEY_X_M - robot.MAST_X_M
    carriage_z = robot.KEY_HEIGHT_AT_LOWER_STOP_M - robot.BASE_HEIGHT_M - foot
    return f"""
      <body name="mast" pos="{_vector(robot.MAST_X_M, 0.0, foot)}">
        <geom name="mast" type="box" pos="0 0 {half}" size="0.03 0.03 {half}" mass="{robot.MAST_MASS_KG}" {SHELL}/>
        <body name="carriage" pos="{_vector(0.0, 0.0, carriage_z)}">
          <joint name="lift" type="slide" axis="0 0 1" range="0 {robot.LIFT_STROKE_M}" damping="200" armature="2"/>
          <geom name="arm" type="box" pos="{reach / 2.0} 0 0" size="{reach / 2.0 - 0.02} 0.015 0.01"
            mass="{robot.CARRIAGE_MASS_KG}" {SHELL}/>
          <geom name="key" type="box" pos="{reach} 0 0" size="0.02 0.02 0.035" mass="{robot.KEY_MASS_KG}" {SHELL}/>
        </body>
      </body>"""


def _wheel(name: str, position: robot.Vector) -> str:
    return f"""
      <body name="{name}_wheel" pos="{_vector(*position)}">
        <inertial pos="0 0 0" mass="{robot.WHEEL_MASS_KG}" diaginertia="0.0013 0.0024 0.0013"/>
        <joint name="{name}" type="hinge" axis="0 1 0" damping="0.02" armature="{WHEEL_ARMATURE_KGM2}"/>
        <geom name="{name}_tyre" type="cylinder" size="{robot.WHEEL_RADIUS_M} {robot.WHEEL_WIDTH_M / 2.0}"
          euler="1.5707963268 0 0" group="2" contype="0" conaffinity="1"/>
      </body>"""
