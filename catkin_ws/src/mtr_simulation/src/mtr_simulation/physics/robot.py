"""Geometry and masses of the simulated robot; its URDF has the same numbers, and a test compares them.

The base follows the published URDF and controller configuration of a Clearpath Jackal. Lengths in m, masses in kg,
positions in base_link (REP-103) unless they say otherwise.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

Vector = Tuple[float, float, float]

# Base: mass properties and boxes without wheels.
WHEEL_RADIUS_M = 0.098
WHEEL_WIDTH_M = 0.040
WHEEL_HEIGHT_IN_BASE_M = 0.0345
WHEEL_MASS_KG = 0.477
HALF_WHEELBASE_M = 0.131
HALF_TRACK_M = 0.187795
WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
WHEEL_POSITIONS: Tuple[Vector, ...] = tuple(
    (end * HALF_WHEELBASE_M, side * HALF_TRACK_M, WHEEL_HEIGHT_IN_BASE_M) for end in (1, -1) for side in (1, -1))
BASE_HEIGHT_M = WHEEL_RADIUS_M - WHEEL_HEIGHT_IN_BASE_M  # base_link above ground
BASE_MASS_KG = 16.523
CHASSIS_SIZE: Vector = (0.42, 0.31, 0.184)
CHASSIS_CENTRE: Vector = (0.0, 0.0, 0.092)
FENDERS_SIZE: Vector = (0.508, 0.43, 0.06)
FENDERS_CENTRE: Vector = (0.0, 0.0, 0.13)

# LiDARs: x in base_link, yaw in rad, plane above ground.
LIDAR_HEIGHT_M = 0.30
FRONT_LIDAR_X_M, FRONT_LIDAR_YAW_RAD = 0.12, 0.0
REAR_LIDAR_X_M, REAR_LIDAR_YAW_RAD = -0.20, 3.141592653589793
LIDAR_MASS_KG = 1.1

# Mast, lift and key. The key is what is foremost, so that it can be brought close to the Car.
MAST_X_M = -0.06
MAST_LENGTH_M = 1.40
MAST_MASS_KG = 4.0
LIFT_STROKE_M = 1.2
KEY_HEIGHT_AT_LOWER_STOP_M = 0.35  # above ground
KEY_X_M = 0.25
CARRIAGE_MASS_KG = 0.8
KEY_MASS_KG = 0.08
