"""rosrun mtr_bringup calibrate lever|mast|wheels|lift|press|status: guided calibration of the robot, with a record.

The person moves the robot, by the manual controller or by hand; this program only asks, listens and writes the record,
which the Operator's application takes (--calibration FILE). `status` tells what was measured when, and what is overdue.
Exit status: 0 measured, or nothing overdue; 1 not measured, or something overdue; 2 wrong options or no ROS master.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import datetime
import pathlib
import sys
from typing import List, Optional

import rospy

from mtr_core.errors import RobotError

from ..preflight.command_line import master_answers
from .console import Console
from .guides import GUIDES
from .record import Origin, overdue, updated
from .record_file import load, save
from .robot import Robot

UNUSABLE = 2
DEFAULT_RECORD = pathlib.Path("~/mtr_calibration.yaml")


def main(arguments: Optional[List[str]] = None) -> int:
    """Guide through one calibration; its exit status."""
    options = parsed(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    path = options.record.expanduser()
    try:
        return status(path) if options.what == "status" else calibrated(options, path)
    except RobotError as error:
        print(error, file=sys.stderr)
        return 1
    except (KeyboardInterrupt, EOFError):
        print("Ended by you; the record is as before.", file=sys.stderr)
        return 1


def parsed(arguments: List[str]) -> argparse.Namespace:
    """Options of the command line."""
    parser = argparse.ArgumentParser(prog="calibrate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=[*GUIDES, "status"])
    parser.add_argument("--record", type=pathlib.Path, default=DEFAULT_RECORD,
                        help=f"the robot's calibration record ({DEFAULT_RECORD})")
    parser.add_argument("--robot", default="", help="which robot it is; asked for when the record does not say")
    parser.add_argument("--by", default="", help="who measures; asked for otherwise")
    return parser.parse_args(arguments)


def status(path: pathlib.Path) -> int:
    """Say what was measured when, and what is overdue."""
    document = load(path)
    if document is None:
        print(f"There is no record {path}; nothing was measured, and the design's counts.")
        return 1
    for each in document.get("checks", []):
        print(f"{each['name']}: {each['value']:g}, 1 sigma {each['uncertainty']:g}, {each['date']}, {each['by']}, "
              f"{each['source']}")
    sentences = overdue(document, datetime.date.today())
    for sentence in sentences:
        print(sentence)
    return int(bool(sentences))


def calibrated(options: argparse.Namespace, path: pathlib.Path) -> int:
    """Ask, measure and write the record."""
    # A record that cannot be read is told before the work, not after it.
    document = load(path)
    if not master_answers():
        print("There is no ROS master; start the robot first (roslaunch mtr_bringup robot.launch).", file=sys.stderr)
        return UNUSABLE
    rospy.init_node("calibrate", anonymous=True, disable_signals=True)
    robot, console = Robot(), Console(input, print)
    key_ahead_m = robot.key().x_m
    name = options.robot or (document or {}).get("robot") or input("Which robot is it? ").strip()
    by = options.by or input("Who measures? ").strip()
    origin = Origin(name or "unnamed", by or "unnamed", key_ahead_m)
    for check in GUIDES[options.what](console, robot):
        document = updated(document, origin, check, datetime.date.today())
    if document is not None:
        save(path, document)
        print(f"Recorded in {path}; copy it to the Operator's laptop, and choose it there as calibration record.")
    return 0
