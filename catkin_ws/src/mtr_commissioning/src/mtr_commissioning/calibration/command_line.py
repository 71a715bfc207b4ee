"""rosrun mtr_commissioning calibrate lever|mast|wheels|lift|press|balance|lidars|status: guided, with a record.

The person moves the robot, by the manual controller or by hand; this program prompts, measures and writes the record,
which the Operator's application reads (--calibration FILE). `status` lists the dates of the measurements, and which are
overdue.
Exit status: 0 measured, or nothing overdue; 1 not measured, or something overdue; 2 wrong options or no ROS master.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import datetime
import os
import pathlib
import sys
from typing import Any, List, Mapping, Optional, Sequence

import rospy

from mtr_core.errors import RobotError
from mtr_description.shipped import shipped_geometry
from mtr_graph_watch.environment import join_on_loopback
from mtr_graph_watch.master import master_answers

from .console import Console
from .guides import GUIDES
from .lidars import measured
from .record import LEVER, Check, Origin, continued, overdue, refuse_another, updated
from .record_file import load, save
from .robot import Robot

UNUSABLE = 2
# From a recorded drive, without a robot.
LIDARS = "lidars"
DEFAULT_RECORD = pathlib.Path("~/mtr_calibration.yaml")


def main(arguments: Optional[List[str]] = None) -> int:
    """Guide through one calibration; return the exit status."""
    options = parsed(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    path = options.record.expanduser()
    join_on_loopback(os.environ)
    try:
        return status(path) if options.what == "status" else calibrated(options, path)
    except RobotError as error:
        print(error, file=sys.stderr)
        return 1
    except (KeyboardInterrupt, EOFError):
        print("Ended by you; the record is as before.", file=sys.stderr)
        return 1


def parsed(arguments: List[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(prog="calibrate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=[*GUIDES, LIDARS, "status"])
    parser.add_argument("--bag", type=pathlib.Path, help="of lidars: a recorded drive, ahead, back and in turns")
    parser.add_argument("--record", type=pathlib.Path, default=DEFAULT_RECORD,
                        help=f"the robot's calibration record ({DEFAULT_RECORD})")
    parser.add_argument("--robot", default="", help="which robot it is; asked for when the record does not say")
    parser.add_argument("--by", default="", help="who measures; asked for otherwise")
    options = parser.parse_args(arguments)
    if (options.what == LIDARS) != (options.bag is not None):
        parser.error("lidars needs --bag FILE, a recorded drive (rosrun mtr_recording record --profile full), and the "
                     "others take none.")
    return options


def status(path: pathlib.Path) -> int:
    """Print the dates of the measurements, and which are overdue."""
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
    """Prompt, measure and write the record."""
    # An unreadable record, or one of another robot, is reported before the work.
    document = load(path)
    if document is not None and options.robot:
        refuse_another(document, options.robot)
    if options.what == LIDARS:
        said, found = measured(options.bag)
        print("\n".join(said))
        key_ahead_m = document["key_ahead_m"] if document else shipped_geometry().key().x_m
        return recorded(options, path, document, found, key_ahead_m)
    if not master_answers():
        print("There is no ROS master; start the robot first (roslaunch mtr_bringup robot.launch).", file=sys.stderr)
        return UNUSABLE
    rospy.init_node("calibrate", anonymous=True, disable_signals=True)
    robot, console = Robot(), Console(input, print)
    return recorded(options, path, document, GUIDES[options.what](console, robot), robot.key().x_m)


def recorded(options: argparse.Namespace, path: pathlib.Path, document: Optional[Mapping[str, Any]],
             found: Sequence[Check], key_ahead_m: float) -> int:
    """Add the measurements to the record."""
    name = options.robot or (document or {}).get("robot") or input("Which robot is it? ").strip()
    by = options.by or input("Who measures? ").strip()
    origin = Origin(name or "unnamed", by or "unnamed", key_ahead_m)
    if document is not None:
        document, doubt = continued(document, key_ahead_m)
        if doubt and all(check.name != LEVER for check in found):
            print(doubt)
    for check in found:
        document = updated(document, origin, check, datetime.date.today())
    if document is not None:
        save(path, document)
        print(f"Recorded in {path}; copy it to the Operator's laptop, and choose it there as calibration record.")
    return 0
