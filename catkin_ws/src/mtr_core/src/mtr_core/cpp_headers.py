"""Writes the C++ headers of names, schedule and sensor figures from their Python tables, at build time.

Usage: python -m mtr_core.cpp_headers FOLDER
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys
from typing import Any, Dict, List

from mtr_core import names, schedule, sensor_figures
from mtr_core.schedule import Slot
from mtr_core.sensor_figures import SensorFigure

HEAD = """/// @file
/// {brief} Made from mtr_core/{source}; not to be edited.
// SPDX-License-Identifier: Apache-2.0
#pragma once

"""


def names_header() -> str:
    """Return the header with each topic, frame and parameter name of names.py as a constant."""
    lines = [f'inline constexpr char {cpp_name(name)}[] = "{value}";' for name, value in constants(names, str).items()]
    return _header("Names of topics, frames and parameters.", "names.py", "mtr_core::names", lines)


def schedule_header() -> str:
    """Return the header with each slot and the wait limits of schedule.py as constants."""
    lines = [f"inline constexpr Slot {cpp_name(name)}{{{slot.period_ns}, {slot.phase_ns}}};"
             for name, slot in constants(schedule, Slot).items()]
    lines += [
        f"inline constexpr std::int64_t kSimulationStartNs = {schedule.SIMULATION_START_NS};",
        f"inline constexpr double kProducerLostAfterWallS = {schedule.PRODUCER_LOST_AFTER_WALL_S};",
        f"inline constexpr double kLateProducerShare = {schedule.LATE_PRODUCER_SHARE};",
        f"inline constexpr std::size_t kKeptSamples = {schedule.KEPT_SAMPLES};",
    ]
    text = _header("Ticks of the periodic nodes, ns of the ROS clock.", "schedule.py", "mtr_core", lines)
    return text.replace("#pragma once\n", "#pragma once\n\n#include <cstddef>\n#include <cstdint>\n\n"
                                          '#include "mtr_core/slot.hpp"\n', 1)


def sensor_figures_header() -> str:
    """Return the header with each figure of sensor_figures.py as a constant in full precision."""
    lines = [f'inline constexpr SensorFigure {cpp_name(name)}{{{value!r}, {low!r}, {high!r}, "{unit}"}};'
             for name, (value, low, high, unit) in constants(sensor_figures, SensorFigure).items()]
    lines += [f"inline constexpr double {cpp_name(name)} = {value!r};"
              for name, value in constants(sensor_figures, float).items()]
    text = _header("How wrong the sensors are; sources are in the table.", "sensor_figures.py",
                   "mtr_core::sensor_figures", lines)
    return text.replace("#pragma once\n", '#pragma once\n\n#include "mtr_core/sensor_figure.hpp"\n', 1)


def constants(module: Any, kind: type) -> Dict[str, Any]:
    """Return the constants of a module by name, in the order of definition."""
    return {name: value for name, value in vars(module).items() if name.isupper() and isinstance(value, kind)}


def cpp_name(python_name: str) -> str:
    """Return the C++ name, such as kMotionPlanner for MOTION_PLANNER."""
    return "k" + "".join(word.capitalize() for word in python_name.split("_"))


def write(folder: pathlib.Path) -> None:
    """Write all headers; an unchanged file is not touched, to avoid recompilation."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, header in HEADERS.items():
        path, text = folder / name, header()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def _header(brief: str, source: str, namespace: str, lines: List[str]) -> str:
    body = "\n".join(lines)
    return (HEAD.format(brief=brief, source=source) + f"namespace {namespace} {{\n\n{body}\n\n"
            f"}}  // namespace {namespace}\n")


HEADERS = {"names.hpp": names_header, "schedule.hpp": schedule_header, "sensor_figures.hpp": sensor_figures_header}

if __name__ == "__main__":
    write(pathlib.Path(sys.argv[1]))
