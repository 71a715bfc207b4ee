"""Speed of the complete demo: both scenarios, the robot's nodes, the simulator and the application."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_simulation.demo import DemoError, DemoOptions, run_demo
from mtr_simulation.stack import StackError


@dataclass(frozen=True)
class WholeStackFigures:
    """Robot time divided by wall time, including start-up and pictures; None if the demo failed, with the problems as
    reason."""

    real_time_factor: Optional[float]
    robot_s: Optional[float] = None
    wall_s: Optional[float] = None
    problems: Tuple[str, ...] = ()


def measure_whole_stack(folder: pathlib.Path) -> WholeStackFigures:
    """Run the demo with its results in a folder, whose previous content is deleted."""
    try:
        demo = run_demo(DemoOptions(folder))
    except (StackError, DemoError) as error:
        return WholeStackFigures(None, problems=(str(error),))
    return WholeStackFigures(demo.real_time_factor, demo.robot_s, demo.wall_s, demo.problems)
