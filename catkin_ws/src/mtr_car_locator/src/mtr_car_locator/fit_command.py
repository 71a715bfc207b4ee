"""Command line that fits the Car to recorded surfaces."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import Callable, Iterable, List, Optional, Tuple

from mtr_core.errors import RobotError
from mtr_core.parameters import parameters_from
from mtr_core.se2 import Pose2
from mtr_description.mounts import LidarMounts
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_geometry, urdf_in

from .offline import fit_files, summary_of
from .parameters import LocatorParameters
from .scan import Scan

ReadBag = Callable[[pathlib.Path, LidarMounts], Iterable[Scan]]


def main(read_bag: ReadBag, arguments: Optional[List[str]] = None) -> int:
    """Print the Car; exit status 0 if it was found, 2 after one sentence otherwise."""
    options = _parser().parse_args(arguments)
    try:
        parameters = parameters_from(dict(options.parameter), LocatorParameters)
        scans = read_bag(options.bag, _lidars(options.robot, parameters)) if options.bag else ()
        fit = fit_files(options.folder, Pose2(*options.prior) if options.prior else None, parameters, scans)
    except RobotError as error:
        print(error, file=sys.stderr)
        return 2
    print("\n".join(summary_of(fit)))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="fit", description="Finds and measures the Car in surfaces.csv of a replay.")
    parser.add_argument("folder", type=pathlib.Path, help="folder with surfaces.csv and key_frames.csv")
    parser.add_argument("--bag", type=pathlib.Path, help="the drive that was replayed; its scans make the size exact")
    parser.add_argument("--robot", type=pathlib.Path, help="URDF or xacro file of the robot that drove; default: the "
                        "one of mtr_description")
    parser.add_argument("--prior", type=float, nargs=3, metavar=("X", "Y", "HEADING"),
                        help="guessed pose of the Car in map, m and rad; default: from the starting place")
    parser.add_argument("--parameter", type=_assignment, action="append", default=[], metavar="NAME=VALUE",
                        help="parameter of the Car locator, any number of times")
    return parser


def _lidars(robot_file: Optional[pathlib.Path], parameters: LocatorParameters) -> LidarMounts:
    geometry = RobotGeometry(urdf_in(robot_file)) if robot_file else shipped_geometry()
    return geometry.lidars(parameters.rear_lidar)


def _assignment(text: str) -> Tuple[str, float]:
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME=NUMBER") from None
