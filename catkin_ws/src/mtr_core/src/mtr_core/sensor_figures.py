"""How wrong the robot's sensors are: the true errors of the simulated ones beside what the estimators assume.

The one home of these figures in both languages; `sensor_figures.hpp` is made of it at build time. SIMULATED is the
true error of the simulated sensor, ASSUMED what an estimator takes it to be. Where they differ, the reason stands
beside them. What the data sheet of one kind of LiDAR says is in mtr_description/config/lidars. Sigmas are 1 standard
deviation; densities are per square root of time, distance or angle. Ranges are those of the nodes' parameters.
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


# LiDAR, random error of one range. Repeatability in the data sheets of the Hokuyo UST-10LX and the SICK TiM561 and
# TiM571 is 10 to 20 mm, indoors: the simulated robot has the better end, drives are recorded with the worse one, and
# the estimators take the middle.
SIMULATED_RANGE_NOISE_M = SensorFigure(0.01, 0.0, 0.1, "m")
WORST_RANGE_NOISE_M = SensorFigure(0.02, *SIMULATED_RANGE_NOISE_M[1:])
ASSUMED_RANGE_NOISE_M = SensorFigure(0.015, 0.001, 0.1, "m")
# One return against a surface of the map, in tracking and when the Car is observed again: the range's noise together
# with the surface's roughness. The adjustment has a figure of its own for the surface.
ASSUMED_POINT_M = SensorFigure(ASSUMED_RANGE_NOISE_M.value, 0.001, 0.2, "m")

# LiDAR, constant error of all ranges: accuracy in the same data sheets is 40 to 60 mm at most. The simulated LiDAR has
# none by default; the adjustment estimates it.
SIMULATED_RANGE_BIAS_M = SensorFigure(0.0, -0.1, 0.1, "m")
ASSUMED_RANGE_BIAS_M = SensorFigure(0.03, 0.0001, 0.1, "m")

# LiDAR, direction of a beam: the simulated one has no error but that of its slices in time. The two assumed figures
# stand for different things. Tracking takes one return of one sweep, and nothing else in the return's variance stands
# for the motion within the sweep. The adjustment takes the mean of a surface's returns in a key frame, mounting and
# motion within the sweep included, and adds the surface's own error (surface_sigma_m) to it. Neither is from a data
# sheet or was measured by itself.
ASSUMED_RETURN_DIRECTION_RAD = SensorFigure(0.002, 0.0, 0.05, "rad")
ASSUMED_VIEW_DIRECTION_RAD = SensorFigure(0.001, 0.0, 0.01, "rad")

# LiDAR, shares of the beams that are wrong altogether; none by default.
SIMULATED_MIXED_PIXEL_SHARE = SensorFigure(0.0, 0.0, 1.0, "(share)")
SIMULATED_DROPOUT_SHARE = SensorFigure(0.0, 0.0, 0.5, "(share)")
SIMULATED_ECHO_SHARE = SensorFigure(0.0, 0.0, 0.2, "(share)")

# Gyro, white noise density: 0.007 deg/s/sqrt(Hz), data sheet of the Bosch BMI270; assumed is the same, rounded up.
# Another gyro has another; 1.75e-4 for the MPU-9250.
SIMULATED_GYRO_NOISE_RADPS_PER_SQRT_HZ = SensorFigure(math.radians(0.007), 0.0, 0.01, "rad/s/sqrt(Hz)")
ASSUMED_GYRO_NOISE_RADPS_PER_SQRT_HZ = SensorFigure(1.25e-4, 1e-6, 0.1, "rad/s/sqrt(Hz)")
# Gyro, random walk of the bias: 8e-5 rad/s (17 deg/h) after 100 s, usual in the BMI270's class; its data sheet names
# none.
SIMULATED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S = SensorFigure(8e-6, 0.0, 0.001, "rad/s/sqrt(s)")
ASSUMED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S = SensorFigure(
    SIMULATED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S.value, 1e-8, 0.01, "rad/s/sqrt(s)")
# Gyro, constant bias: 0.2 deg/s of a calibrated sensor, in simulation; about 3 deg/s of an uncalibrated MEMS gyro at
# switch-on by data sheet, which localization has to begin with.
SIMULATED_GYRO_BIAS_RADPS = SensorFigure(math.radians(0.2), 0.0, 0.1, "rad/s")
ASSUMED_GYRO_BIAS_AT_START_RADPS = 0.05
# Gyro, error of scale after it was compared with full turns against a mark; 0.005 by data sheet when it was not. The
# simulated one has none by default; recorded drives have that of a gyro that was compared.
SIMULATED_GYRO_SCALE_ERROR = SensorFigure(0.0, -0.05, 0.05, "(relative)")
ASSUMED_GYRO_SCALE = SensorFigure(0.001, 0.0001, 0.1, "of the turn")
COMPARED_GYRO_SCALE_ERROR = SensorFigure(ASSUMED_GYRO_SCALE.value, *SIMULATED_GYRO_SCALE_ERROR[1:])

# Accelerometer, white noise density: 160 ug/sqrt(Hz), data sheet of the BMI270. No estimator uses it.
SIMULATED_ACCELEROMETER_NOISE_MPS2_PER_SQRT_HZ = SensorFigure(160e-6 * 9.81, 0.0, 0.1, "m/s2/sqrt(Hz)")
# Accelerometer, constant bias: 5 mg after calibration (data sheets of MEMS accelerometers), here in parts of gravity.
ASSUMED_ACCELEROMETER_BIAS = 0.005
SIMULATED_ACCELEROMETER_BIAS_MPS2 = SensorFigure(ASSUMED_ACCELEROMETER_BIAS * 9.81, 0.0, 1.0, "m/s2")
# Accelerometer, random walk of the bias: 1e-3 m/s2 after 100 s. No estimator uses it.
SIMULATED_ACCELEROMETER_BIAS_WALK_MPS2_PER_SQRT_S = SensorFigure(1e-4, 0.0, 0.01, "m/s2/sqrt(s)")

# Wheels, radius as mounted and inflated against its nominal value: one simulated error, within 1 sigma of what is
# assumed.
SIMULATED_WHEEL_RADIUS_ERROR = SensorFigure(0.003, -0.05, 0.05, "(relative)")
ASSUMED_WHEEL_SCALE = SensorFigure(0.005, 0.0001, 0.1, "of the distance")
# Wheels, slip along the path: 1 mm after 1 m. In simulation, without joints and gravel, physics make 0.3 mm; not
# measured on asphalt.
ASSUMED_SLIP_M_PER_SQRT_M = SensorFigure(0.001, 0.0, 0.5, "m/sqrt(m)")
# Wheels, shift of base_link while a skid-steered base turns about a point that is not base_link: 6 mm after 1 rad, 6 cm
# after a test with 90 rad. In simulation a quarter turn on the spot shifts it by 1 cm, and of a whole test's turns,
# which cancel in part, this much remains; see docs/accuracy.md.
ASSUMED_TURN_SLIP_M_PER_SQRT_RAD = SensorFigure(0.006, 0.0, 0.5, "m/sqrt(rad)")
