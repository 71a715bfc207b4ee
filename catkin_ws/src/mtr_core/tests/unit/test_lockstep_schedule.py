"""The C++ headers of names, schedule and sensor figures, as generated at build time."""
# SPDX-License-Identifier: Apache-2.0
import re

import pytest

from mtr_core import cpp_headers, names, schedule, sensor_figures
from mtr_core.schedule import Slot
from mtr_core.sensor_figures import SensorFigure


@pytest.mark.parametrize("python_name, cpp_name", [("MAP", "kMap"), ("IMU_DATA", "kImuData")])
def test_names_follow_the_style_of_cpp(python_name, cpp_name):
    assert cpp_headers.cpp_name(python_name) == cpp_name


def test_every_name_has_a_constant_of_its_own():
    found = dict(re.findall(r'constexpr char (k\w+)\[\] = "([^"]+)";', cpp_headers.names_header()))
    texts = {name: value for name, value in vars(names).items() if name.isupper() and isinstance(value, str)}
    assert found == {cpp_headers.cpp_name(name): value for name, value in texts.items()}
    assert len(found) == len(texts) and found["kWheelCommand"] == names.WHEEL_COMMAND


def test_every_slot_has_its_period_and_phase():
    found = re.findall(r"constexpr Slot (k\w+)\{(\d+), (\d+)\};", cpp_headers.schedule_header())
    slots = {name: value for name, value in vars(schedule).items() if isinstance(value, Slot)}
    assert {name: Slot(int(period), int(phase)) for name, period, phase in found} == {
        cpp_headers.cpp_name(name): value for name, value in slots.items()}


def test_limits_of_waiting_and_the_start_are_in_the_schedule():
    text = cpp_headers.schedule_header()
    assert f"kSimulationStartNs = {schedule.SIMULATION_START_NS};" in text
    assert f"kProducerLostAfterWallS = {schedule.PRODUCER_LOST_AFTER_WALL_S};" in text
    assert f"kKeptSamples = {schedule.KEPT_SAMPLES};" in text


def test_every_sensor_figure_has_all_its_digits_range_and_unit():
    text = cpp_headers.sensor_figures_header()
    found = re.findall(r'constexpr SensorFigure (k\w+)\{(\S+), (\S+), (\S+), "([^"]+)"\};', text)
    figures = {name: value for name, value in vars(sensor_figures).items() if isinstance(value, SensorFigure)}
    made = {name: SensorFigure(float(value), float(low), float(high), unit) for name, value, low, high, unit in found}
    assert made == {cpp_headers.cpp_name(name): value for name, value in figures.items()}
    assert "constexpr double kAssumedGyroBiasAtStartRadps = 0.05;" in text


def test_headers_that_would_not_change_are_not_written_again(tmp_path):
    cpp_headers.write(tmp_path)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    cpp_headers.write(tmp_path)
    assert {path.name for path in before} == {"names.hpp", "schedule.hpp", "sensor_figures.hpp"}
    assert {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == before
