"""How wrong a sensor is stands in one file: no other gives these parameters a number, and all defaults are its own.

What the data sheet of one kind of LiDAR says stands in the file of that kind.
"""
# SPDX-License-Identifier: Apache-2.0
import re

import pytest
from project import TOP, tracked

from mtr_benchmarks.localization.drives.options import DriveOptions
from mtr_car_locator.watch.comparison import POINT_SIGMA_M
from mtr_core import sensor_figures as figures
from mtr_simulation.physics.wheels import BaseParameters
from mtr_simulation.sensors.imu import ImuParameters
from mtr_simulation.sensors.lidar import LidarParameters

HOME = TOP / "catkin_ws" / "src" / "mtr_core" / "src" / "mtr_core" / "sensor_figures.py"
KINDS = TOP / "catkin_ws" / "src" / "mtr_description" / "config" / "lidars"
NAMES = (
    "noise_m", "range_noise_m", "range_sigma_m", "range_bias_m", "range_bias_sigma_m", "bearing_sigma_rad",
    "beam_angle_sigma_rad", "mixed_pixel_share", "dropout_share", "echo_share", "gyro_density",
    "gyro_noise_radps_per_sqrt_hz", "gyro_bias_radps", "gyro_bias_walk", "gyro_bias_walk_radps_per_sqrt_s",
    "gyro_scale_error", "gyro_scale_sigma", "accelerometer_density", "accelerometer_bias_mps2",
    "accelerometer_bias_walk", "radius_error", "wheel_scale_sigma", "slip_m_per_sqrt_m", "turn_slip_m_per_sqrt_rad",
)
ANY_NAME = f"(?:{'|'.join(NAMES)})"
DECLARED = re.compile("|".join((
    # A default in Python or C++; zero is what an estimate in C++ begins with.
    rf"\b{ANY_NAME}(?:: float)? = (?:number\()?(?:math\.\w+\()?-?(?!0\.0;?$)[\d.]",
    # A row of a table of ranges.
    rf'\{{"{ANY_NAME}", &\w+::\w+, -?[\d.]',
    # A value in YAML or a launch file.
    rf"^\s*{ANY_NAME}:\s+-?[\d.e-]+\s*(?:#|$)",
    rf'name="{ANY_NAME}" (?:default|value)="-?[\d.]',
)))


def declarations(text):
    """Lines of a file that give one of the parameters a number."""
    return [line.strip() for line in text.splitlines() if DECLARED.search(line)]


@pytest.mark.parametrize("line", [
    '    noise_m: float = number(0.01, 0.0, 0.1, "m")', '    gyro_density: float = number(math.radians(0.007), 0.0)',
    "  double bearing_sigma_rad = 0.001;", '  {"range_sigma_m", &Parameters::range_sigma_m, 0.001, 0.2, "m"},',
    "beam_angle_sigma_rad: 0.002", '<param name="wheel_scale_sigma" value="0.005"/>'])
def test_second_declaration_is_found(line):
    assert declarations(line) == [line.strip()]


def test_no_other_file_declares_a_sensor_s_error():
    files = tracked("*.py", "*.hpp", "*.cpp", "*.yaml", "*.launch", "*.xacro")
    found = {str(path.relative_to(TOP)): declarations(path.read_text(encoding="utf-8"))
             for path in files if "tests" not in path.parts and path != HOME and path.parent != KINDS}
    assert not {path: lines for path, lines in found.items() if lines}


def test_defaults_are_those_of_the_table():
    lidar, imu, drive = LidarParameters(), ImuParameters(), DriveOptions()
    assert lidar.noise_m == figures.SIMULATED_RANGE_NOISE_M.value == 0.01
    assert drive.range_noise_m == figures.WORST_RANGE_NOISE_M.value == 0.02
    assert imu.gyro_bias_walk == figures.ASSUMED_GYRO_BIAS_WALK_RADPS_PER_SQRT_S.value == 8e-6
    assert imu.accelerometer_bias_mps2 == 0.005 * 9.81
    assert BaseParameters().radius_error == figures.SIMULATED_WHEEL_RADIUS_ERROR.value == 0.003
    assert POINT_SIGMA_M == figures.ASSUMED_POINT_M.value == figures.ASSUMED_RANGE_NOISE_M.value == 0.015


@pytest.mark.parametrize("name, figure", [(name, value) for name, value in vars(figures).items()
                                          if isinstance(value, figures.SensorFigure)])
def test_figure_is_in_its_range_and_has_a_unit(name, figure):
    assert figure.low <= figure.value <= figure.high and figure.unit, name
