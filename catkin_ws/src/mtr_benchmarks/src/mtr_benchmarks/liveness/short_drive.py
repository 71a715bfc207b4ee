"""Maps the Car and drives around it with the simulated robot on the machine's clock, to test a platform.

Usage: python -m mtr_benchmarks.liveness.short_drive --out out/bench
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
import time
from dataclasses import asdict, dataclass
from typing import Any, List, Optional, Sequence, Set

from mtr_proto import robot_link_pb2 as link

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from .alarms import AlarmWatch
from .judge import Motion
from .live_robot import MACHINE_CLOCK, LiveRobot

PLACES = 4
MAP_LIMIT_S, PLACES_LIMIT_S = 180.0, 180.0
# Path from one side of the Car to the other and back, 6.4 m each as the crow flies.
LEAST_WAY_M = 12.0
# Wheel readings come 20 ms apart; longer pauses are left out of the path length.
MAX_STEP_S = 0.5

MAPPED = Requirement("the Car is mapped after", "s", must=MAP_LIMIT_S)
REACHED = Requirement("places reached", "(count)", must=float(PLACES), at_least=True)
WAY = Requirement("way of the wheels", "m", must=LEAST_WAY_M, at_least=True)
ALARMS = Requirement("alarms of the nodes; a machine with other work has some", "(count)", goal=0.0)


@dataclass(frozen=True)
class Drive:
    """Result of a drive; the robot leaves for the first place when the Car is mapped."""

    mapped_after_s: float
    places_reached: int
    way_m: float
    alarms: List[str]


def main(arguments: Optional[List[str]] = None) -> int:
    """Drive; return 0 if every row meets its requirement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    options = parser.parse_args(arguments)
    with LiveRobot(options.out / "short_drive", clock=MACHINE_CLOCK) as robot:
        found = driven(robot)
    return finish(BenchmarkReport(rows(found), asdict(found), found.alarms), options.out / "short_drive.json")


def driven(robot: LiveRobot) -> Drive:
    """Map the Car and drive to the places.

    Raises:
        LiveError: the robot does not get through.
    """
    robot.start()
    began_s, watch = time.monotonic(), AlarmWatch()
    robot.wait_for_motion(MAP_LIMIT_S)
    # States before the start, such as the stop that held the robot, are not alarms.
    watch.take()
    robot.wait_until(lambda: robot.knows_car, "the Car mapped", MAP_LIMIT_S)
    mapped_after_s, first = time.monotonic() - began_s, len(robot.wheels)
    places: Set[int] = set()
    robot.wait_until(lambda: len(reached(places, robot.status)) >= PLACES, f"{PLACES} places reached", PLACES_LIMIT_S)
    return Drive(mapped_after_s, len(places), way_m(robot.wheels[first:]), list(watch.take()))


def reached(places: Set[int], status: Any) -> Set[int]:
    """Add the place that a Status reports as reached; a refused place does not count."""
    if status.waypoint_result == link.WAYPOINT_RESULT_REACHED:
        places.add(status.waypoint_id)
    return places


def way_m(wheels: Sequence[Motion]) -> float:
    """Return the path length of the wheels, forwards and backwards, m."""
    return sum(abs(before.linear_mps) * (now.time_s - before.time_s) for before, now in zip(wheels, wheels[1:])
               if now.time_s - before.time_s < MAX_STEP_S)


def rows(found: Drive) -> List[Row]:
    """Return the rows of a drive."""
    return [Row(MAPPED, found.mapped_after_s), Row(REACHED, float(found.places_reached)), Row(WAY, found.way_m),
            Row(ALARMS, float(len(found.alarms)))]


if __name__ == "__main__":
    sys.exit(main())
