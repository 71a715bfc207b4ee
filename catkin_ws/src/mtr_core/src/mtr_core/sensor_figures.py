"""Errors of the robot's sensors: true errors of the simulated sensors, and assumptions of the estimators.

This table defines the figures for both languages; `sensor_figures.hpp` is generated from it at build time. SIMULATED is
the true error of the simulated sensor, ASSUMED the value of an estimator. A comment explains each difference. Data
sheet values of one model of LiDAR are in mtr_description/config/lidars. Sigmas are 1 standard deviation; densities are
per square root of time, distance or angle. Ranges apply to the nodes' parameters.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple


class SensorFigure(NamedTuple):
    """Value of one error with the range that a parameter may have, ends included, and the unit of all three."""

    value: float
    low: float
    high: float
    unit: str


# LiDAR, random error of one range. The data sheets of the Hokuyo UST-10LX and the SICK TiM561 and TiM571 specify a
# repeatability of 10 to 20 mm indoors. The simulated robot has the lower value, recorded drives the higher one, and the
# estimators assume the middle.
SIMULATED_RANGE_NOISE_M = SensorFigure(0.01, 0.0, 0.1, "m")
WORST_RANGE_NOISE_M = SensorFigure(0.02, *SIMULATED_RANGE_NOISE_M[1:])
ASSUMED_RANGE_NOISE_M = SensorFigure(0.015, 0.001, 0.1, "m")
# One return against a surface of the map, in tracking and when the Car is observed again: the range noise together with
# the surface's roughness. The adjustment has its own figure for the surface.
ASSUMED_POINT_M = SensorFigure(ASSUMED_RANGE_NOISE_M.value, 0.001, 0.2, "m")

# LiDAR, constant error of all ranges: the same data sheets specify an accuracy of at most 40 to 60 mm. The simulated
# LiDAR has no such error by default; the adjustment estimates it.
SIMULATED_RANGE_BIAS_M = SensorFigure(0.0, -0.1, 0.1, "m")
ASSUMED_RANGE_BIAS_M = SensorFigure(0.03, 0.0001, 0.1, "m")

# LiDAR, direction of a beam: the simulated LiDAR has only the error of its time slices. The two assumed figures have
# different meanings. Tracking uses single returns of one sweep; this figure also covers the motion within the sweep,
# which the return's variance does not include otherwise. The adjustment uses the mean of a surface's returns in a key
# frame, including mounting and motion within the sweep, and adds the surface's own error (surface_sigma_m). Neither
# figure is from a data sheet or was measured separately.
ASSUMED_RETURN_DIRECTION_RAD = SensorFigure(0.002, 0.0, 0.05, "rad")
ASSUMED_VIEW_DIRECTION_RAD = SensorFigure(0.001, 0.0, 0.01, "rad")

# LiDAR, shares of the beams with gross errors; none by default.
SIMULATED_MIXED_PIXEL_SHARE = SensorFigure(0.0, 0.0, 1.0, "(share)")
SIMULATED_DROPOUT_SHARE = SensorFigure(0.0, 0.0, 0.5, "(share)")
SIMULATED_ECHO_SHARE = SensorFigure(0.0, 0.0, 0.2, "(share)")

# Gyro, white noise density: 0.007 deg/s/sqrt(Hz), data sheet of the Bosch BMI270; the assumed value is rounded up.
# Other gyros differ, such as 1.75e-4 rad/s/sqrt(Hz) for the MPU-9250.
SIMULATED_GYRO_NOISE_RADPS_PER_SQRT_HZ = SensorFigure(math.radians(0.007), 0.0, 0.01, "rad/s/sqrt(Hz)")
ASSUMED_GYRO_NOISE_RADPS_PER_SQRT_HZ = SensorFigure(1.25e-4, 1e-6, 0.1, "rad/s/sqrt(Hz)")
# Gyro, random walk of the bias: 8e-5 rad/s (17 deg/h) after 100 s, typical of the BMI270's class; its data sheet does
# not specify it.
SIMULATED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S = SensorFigure(8e-6, 0.0, 0.001, "rad/s/sqrt(s)")
ASSUMED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S = SensorFigure(
    SIMULATED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S.value, 1e-8, 0.01, "rad/s/sqrt(s)")
# Gyro, constant bias: 0.2 deg/s of a calibrated sensor in simulation. Localization starts with about 3 deg/s, the data
# sheet value of an uncalibrated MEMS gyro at switch-on.
SIMULATED_GYRO_BIAS_RADPS = SensorFigure(math.radians(0.2), 0.0, 0.1, "rad/s")
ASSUMED_GYRO_BIAS_AT_START_RADPS = 0.05
# Gyro, scale error after calibration with full turns against a mark; 0.005 by data sheet without calibration. The
# simulated gyro has none by default; recorded drives have the error of a calibrated gyro.
SIMULATED_GYRO_SCALE_ERROR = SensorFigure(0.0, -0.05, 0.05, "(relative)")
ASSUMED_GYRO_SCALE = SensorFigure(0.001, 0.0001, 0.1, "of the turn")
COMPARED_GYRO_SCALE_ERROR = SensorFigure(ASSUMED_GYRO_SCALE.value, *SIMULATED_GYRO_SCALE_ERROR[1:])

# Accelerometer, white noise density: 160 ug/sqrt(Hz), data sheet of the BMI270. No estimator uses it.
SIMULATED_ACCELEROMETER_NOISE_MPS2_PER_SQRT_HZ = SensorFigure(160e-6 * 9.81, 0.0, 0.1, "m/s2/sqrt(Hz)")
# Accelerometer, constant bias: 5 mg after calibration (data sheets of MEMS accelerometers), here relative to gravity.
ASSUMED_ACCELEROMETER_BIAS = 0.005
SIMULATED_ACCELEROMETER_BIAS_MPS2 = SensorFigure(ASSUMED_ACCELEROMETER_BIAS * 9.81, 0.0, 1.0, "m/s2")
# Accelerometer, random walk of the bias: 1e-3 m/s2 after 100 s. No estimator uses it.
SIMULATED_ACCELEROMETER_BIAS_WALK_MPS2_PER_SQRT_S = SensorFigure(1e-4, 0.0, 0.01, "m/s2/sqrt(s)")

# Wheels, radius as mounted and inflated relative to its nominal value: one simulated error, within 1 sigma of the
# assumption.
SIMULATED_WHEEL_RADIUS_ERROR = SensorFigure(0.003, -0.05, 0.05, "(relative)")
ASSUMED_WHEEL_SCALE = SensorFigure(0.005, 0.0001, 0.1, "of the distance")
# Wheels, slip along the path: 1 mm after 1 m. Simulation without joints and gravel yields 0.3 mm; not measured on
# asphalt.
ASSUMED_SLIP_M_PER_SQRT_M = SensorFigure(0.001, 0.0, 0.5, "m/sqrt(m)")
# Wheels, shift of base_link because a skid-steered base turns about another point: 6 mm after 1 rad, 6 cm after a test
# with 90 rad. In simulation a quarter turn on the spot shifts it by 1 cm. The turns of a whole test cancel in part, and
# this amount remains; see docs/accuracy.md.
ASSUMED_TURN_SLIP_M_PER_SQRT_RAD = SensorFigure(0.006, 0.0, 0.5, "m/sqrt(rad)")
