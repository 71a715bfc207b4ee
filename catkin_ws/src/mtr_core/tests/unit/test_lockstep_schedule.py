"""The C++ headers of mtr_core repeat the schedule and the names of its Python word for word."""
# SPDX-License-Identifier: Apache-2.0
import re
from pathlib import Path

from mtr_core import names, schedule
from mtr_core.lockstep import samples

HEADERS = Path(__file__).resolve().parents[2] / "include" / "mtr_core"


def python_name(cpp_name):
    """kMotionPlanner as MOTION_PLANNER."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", cpp_name[1:]).upper()


def header(name):
    return (HEADERS / name).read_text(encoding="utf-8")


def cpp_slots():
    found = re.findall(r"constexpr Slot (k\w+) = slot\((\d+)(?:, (\d+))?\);", header("schedule.hpp"))
    return {python_name(name): schedule.slot(int(period), int(phase or 0)) for name, period, phase in found}


def cpp_names():
    return {python_name(name): value
            for name, value in re.findall(r'constexpr char (k\w+)\[\] = "([^"]+)";', header("names.hpp"))}


def test_every_slot_of_the_schedule_is_the_same_in_cpp():
    assert cpp_slots() == {name: value for name, value in vars(schedule).items() if isinstance(value, schedule.Slot)}


def test_simulation_starts_at_the_same_time_in_cpp():
    milliseconds = re.search(r"kSimulationStartNs = ([\d']+) \* kMillisecondNs", header("schedule.hpp")).group(1)
    assert int(milliseconds.replace("'", "")) * schedule.MILLISECOND_NS == schedule.SIMULATION_START_NS


def test_every_name_in_cpp_is_that_of_mtr_core():
    found = cpp_names()
    assert "WHEEL_COMMAND" in found
    assert found == {name: getattr(names, name) for name in found}


def test_limits_of_waiting_are_the_same_in_cpp():
    text = header("samples.hpp")
    assert float(re.search(r"kProducerLostAfterWallS = ([\d.]+);", text).group(1)) == samples.PRODUCER_LOST_AFTER_WALL_S
    assert int(re.search(r"kKeptSamples = (\d+);", text).group(1)) == samples.KEPT_SAMPLES
