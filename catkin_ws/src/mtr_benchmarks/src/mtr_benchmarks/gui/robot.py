"""Robot on the machine's clock in its own process, with as many returns as the link carries.

Usage: python -m mtr_benchmarks.gui.robot; prints its subscriber and publisher port, and serves until it is killed.
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import sys

from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.surroundings import StopZone, Surroundings
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_operator.robot_link.virtual.robot import VirtualRobot

# Largest number of returns and of path points that a robot sends.
POINTS, PATH_POINTS = 500, 200
WALL_M, WAVE_M = 8.0, 1.0


class SeeingRobot(VirtualRobot):
    """Returns a wavy wall all around in every second Status."""

    def status(self) -> RobotStatus:
        """See VirtualRobot."""
        told = super().status()
        return dataclasses.replace(told, surroundings=seen(told)) if told.id % 2 == 0 else told


def seen(status: RobotStatus) -> Surroundings:
    """Return a wavy wall and a path."""
    bearings = [2.0 * math.pi * index / POINTS for index in range(POINTS)]
    ranges = [WALL_M + WAVE_M * math.sin(7.0 * bearing + 0.1 * status.id) for bearing in bearings]
    points = tuple((far * math.cos(bearing), far * math.sin(bearing)) for far, bearing in zip(ranges, bearings))
    return Surroundings(points, points[:PATH_POINTS], StopZone.SLOWED, (1.0, 0.3))


def main() -> int:
    """Serve; return the exit status."""
    with ConnectionServer() as server:
        print(server.subscriber_port, server.publisher_port, flush=True)
        RobotSubstitute(server, robot=SeeingRobot(1)).run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
