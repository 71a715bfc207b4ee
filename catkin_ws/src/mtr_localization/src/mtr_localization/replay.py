"""Play a recorded bag through localization, offline and without a ROS master, and find the Car in the map it gives.

Exit status: 1 when the bag cannot be used or none of its poses is valid, with the reason first.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from dataclasses import replace
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import rosbag
from roslib.packages import find_node

from mtr_core import names
from mtr_core.bags.diagnosis import unreadable, unusable
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2
from mtr_description.mounts import LidarMounts
from mtr_motion_check.bag import motion_in
from mtr_motion_check.judge import MotionJudge

from .any_bag.conversions import Found, convert
from .any_bag.errors import BagUnusable
from .any_bag.frames import yaw_of
from .any_bag.sources import Asked, is_own
from .replay_faults import GAP_LIMIT_S, Topics, causes, faults, is_useless, shows_nothing

# Duration at the start of a drive that is sufficient to compare its sensors.
COMPARED_S = 60.0


def main(arguments: Optional[List[str]] = None) -> int:
    """Replay a bag and print the result; exit status 1 after one sentence if the bag is not usable."""
    options = parser().parse_args(arguments)
    programs = find_node("mtr_localization", "replay_bag")
    if not programs:
        print("The program replay_bag of mtr_localization is not built.", file=sys.stderr)
        return 1
    try:
        asked = asked_of(options)
        topics, start_s = seen_in(options.bag)
        if is_own(topics, asked):
            own = Topics({"front": names.FRONT_SCAN, "rear": names.REAR_SCAN}, names.WHEEL_ODOMETRY, names.IMU_DATA)
            return replayed(programs[0], options, options.bag, Conversion(own, {}, [], [], []), start_s)
        with tempfile.TemporaryDirectory() as folder:
            bag = pathlib.Path(folder) / "inputs.bag"
            found = convert(pathlib.Path(options.bag), bag, asked, options.map is None, show)
            compared = [] if found.faults else against_each_other(bag, found)
            conversion = Conversion(topics_of(found), found.parameters, found.said, compared, found.faults)
            return replayed(programs[0], options, str(bag), conversion, start_s)
    except RobotError as error:
        print(error, file=sys.stderr)
        return 1


class Conversion(NamedTuple):
    """Result of converting a bag of another robot.

    Attributes:
        topics: of the bag.
        parameters: parameters of localization that replace missing inputs.
        remarks: sentences about the inputs.
        comparison: lines that compare its sensors with each other.
        faults: sentences about unusable inputs.
    """

    topics: Topics
    parameters: Dict[str, float]
    remarks: List[str]
    comparison: List[str]
    faults: List[str]


def topics_of(found: Found) -> Topics:
    """Return the topics of another robot's bag; the front LiDAR is the first."""
    return Topics(dict(zip(("front", "rear"), found.mounts)), found.odometry, found.imu)


def replayed(program: str, options: argparse.Namespace, bag: str, conversion: Conversion, start_s: float) -> int:
    """Run the replay of a bag with standard topics and return the exit status."""
    given = [f"{name}={value}" for name, value in conversion.parameters.items()]
    done = subprocess.run([program, *arguments_of(options, bag, given, start_s)], check=False)
    if done.returncode != 0:
        print("\n".join(conversion.remarks), flush=True)
        return done.returncode
    summary = json.loads((options.out / "summary.json").read_text(encoding="utf-8"))
    gap_limit_s = gap_limit_of(options)
    sentences = faults(summary, conversion.topics, gap_limit_s, conversion.faults)
    print("\n".join([*sentences, *conversion.remarks]))
    if summary["scans_used"] and not shows_nothing(summary):
        # Advice from unusable scans would be misleading.
        if not causes(summary, conversion.topics, gap_limit_s, conversion.faults):
            print("\n".join(conversion.comparison))
        report(options, bag, summary)
    return 1 if is_useless(summary) else 0


def gap_limit_of(options: argparse.Namespace) -> float:
    """Return the longest interval of odometry that localization accepts, in s."""
    given = [text.partition("=")[2] for text in options.parameter if text.startswith("gap_limit_s=")]
    return float(given[-1]) if given else GAP_LIMIT_S


def against_each_other(bag: pathlib.Path, found: Found) -> List[str]:
    """Return lines that compare LiDARs, wheels and gyro of a converted bag, and mounts that contradict the scans."""
    places = [place for _, place in found.mounts.values()]
    seen = [Pose2(float(place[0, 3]), float(place[1, 3]), yaw_of(place)) for place in places]
    recording = motion_in(bag, [math.copysign(1.0, place[2, 2]) for place in places])
    begin_s = recording.motion_start_s() or 0.0
    findings = MotionJudge(LidarMounts(seen[0], seen[1] if len(seen) > 1 else None)).findings(
        recording.until(begin_s + COMPARED_S))
    topics = topics_of(found)
    theirs = {names.WHEEL_ODOMETRY: found.odometry, names.IMU_DATA: found.imu,
              names.FRONT_SCAN: topics.scans["front"], names.REAR_SCAN: topics.scans.get("rear")}
    return [replace(finding, subject=theirs.get(finding.subject) or finding.subject).line() for finding in findings
            if found.imu is not None or finding.subject != names.IMU_DATA]


def show(share: float) -> None:
    """Show the progress of the conversion on a terminal."""
    if sys.stderr.isatty():
        print(f"\rreading {100.0 * share:3.0f} %", end="\n" if share >= 1.0 else "", file=sys.stderr, flush=True)


def seen_in(path: str) -> Tuple[Dict[str, str], float]:
    """Return the types of the bag's topics, and its start time in s."""
    reason = unusable(pathlib.Path(path))
    if reason:
        raise BagUnusable(reason)
    try:
        with rosbag.Bag(path) as bag:
            topics = bag.get_type_and_topic_info().topics
            return {topic: about.msg_type for topic, about in topics.items()}, float(bag.get_start_time())
    except Exception as error:
        raise BagUnusable(unreadable(pathlib.Path(path), error)) from None


class Help(argparse.Action):
    """Action that prints the options and the parameters of localization."""

    def __call__(self, command_line: argparse.ArgumentParser, *_: Any) -> None:
        command_line.print_help()
        programs = find_node("mtr_localization", "replay_bag")
        if not programs:
            print("\nThe program replay_bag is not built, so its parameters are not told.")
            command_line.exit()
        told = subprocess.run([programs[0], "--help"], check=True, text=True, capture_output=True).stdout
        # Skip the usage line of the program.
        print(told[told.index("\n"):], end="")
        command_line.exit()


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    parsed = argparse.ArgumentParser(prog="replay", description=__doc__, add_help=False)
    parsed.add_argument("-h", "--help", action=Help, nargs=0, help="show this and each parameter, and end")
    parsed.add_argument("bag", help="recorded drive: scans, IMU, wheel odometry")
    parsed.add_argument("--out", required=True, type=pathlib.Path, help="folder for the results")
    parsed.add_argument("--front-only", action="store_true", help="leave out the rear LiDAR")
    parsed.add_argument("--parameter", action="append", default=[], metavar="NAME=VALUE",
                        help="parameter of localization, any number of times")
    parsed.add_argument("--map", type=pathlib.Path, metavar="FILE",
                        help="map.bag of another replay: localize on it, and make none")
    end = parsed.add_mutually_exclusive_group()
    end.add_argument("--loop-end", metavar="STAMP_S",
                     help="end of the way round the Car; default: by the bag's orders, or when it closes")
    end.add_argument("--loop-end-after", type=float, metavar="S", help="the same in seconds of the bag")
    parsed.add_argument("--in-motion", action="store_true",
                        help="the bag begins while the robot drives: the gyro's bias is not measured first")
    parsed.add_argument("--begin-at", type=float, nargs=3, metavar=("X", "Y", "HEADING"),
                        help="with --map: pose on it at the first odometry, m and rad; default: as the map has it")
    parsed.add_argument("--no-car", action="store_true", help="do not look for the Car in the map")
    other = parsed.add_argument_group("bags of other robots", "what is not named is found by its type")
    other.add_argument("--front-scan", metavar="TOPIC", help="scans of the LiDAR ahead")
    other.add_argument("--rear-scan", metavar="TOPIC|none", help="scans of the one behind")
    other.add_argument("--odometry", metavar="TOPIC|tf", help="nav_msgs/Odometry, or transforms of the robot's frame")
    other.add_argument("--imu", metavar="TOPIC|none", help="gyro; none: the turn of the wheels, with its noise")
    other.add_argument("--base-frame", metavar="FRAME", help="the robot's frame, x ahead; default: the odometry's")
    other.add_argument("--urdf", metavar="FILE", help="URDF or xacro with the mounts, instead of the bag's transforms")
    other.add_argument("--scan-delay", type=float, metavar="S", help="by how much their stamps are late")
    other.add_argument("--time-increment", type=float, metavar="S",
                       help="from beam to beam, instead of the time_increment and scan_time of the scans")
    parsed.add_argument("--prior", type=float, nargs=3, metavar=("X", "Y", "HEADING"),
                        help="guessed pose of the Car in map, m and rad; default: from the starting place")
    return parsed


def asked_of(options: argparse.Namespace) -> Asked:
    """Return the user's selection of topics and frames."""
    return Asked(options.front_scan, options.rear_scan, options.odometry, options.imu, options.base_frame, options.urdf,
                 options.scan_delay, options.time_increment)


def arguments_of(options: argparse.Namespace, bag: str, parameters: List[str], start_s: float) -> List[str]:
    """Return the arguments of the replay program. parameters: NAME=VALUE, before the user's own."""
    arguments = [bag, "--out", str(options.out)]
    arguments += ["--front-only"] if options.front_only else []
    end = options.loop_end if options.loop_end_after is None else f"{start_s + options.loop_end_after:.9f}"
    arguments += ["--loop-end", end] if end else []
    arguments += ["--map", str(options.map)] if options.map else []
    arguments += ["--begin-at", *map(str, options.begin_at)] if options.begin_at else []
    arguments += ["--in-motion"] if options.in_motion else []
    return arguments + [part for each in [*parameters, *options.parameter] for part in ("--parameter", each)]


def report(options: argparse.Namespace, bag: str, summary: Dict[str, Any]) -> None:
    """Print poses, map and Car."""
    print(f"{summary['poses_valid']} of {summary['poses']} poses are valid; "
          f"{summary['cpu_ms_per_scan']:.2f} ms of CPU per scan")
    if options.map:
        return
    if not summary["map_valid"]:
        print(f"No map: {summary['map_message']}")
        return
    print(f"Map of {summary['key_frames']} key-frames and {summary['surfels']} surfaces; range bias "
          f"{1e3 * summary['range_bias_m']:.1f} mm (1 sigma {1e3 * summary['range_bias_sigma_m']:.1f} mm)")
    if not options.no_car:
        print("\n".join(car_lines(options, bag)))


def car_lines(options: argparse.Namespace, bag: str) -> List[str]:
    """Return lines about the Car, or a sentence with the reason why it was not found."""
    try:
        from mtr_car_locator.conversions import scans_in
        from mtr_car_locator.offline import fit_files, summary_of
        from mtr_car_locator.parameters import LocatorParameters
        from mtr_description.shipped import shipped_geometry
    except ImportError:
        return ["The Car is not looked for: package mtr_car_locator is not built."]
    parameters = LocatorParameters()
    scans = scans_in(pathlib.Path(bag), shipped_geometry().lidars(has_rear=not options.front_only))
    try:
        fit = fit_files(options.out, Pose2(*options.prior) if options.prior else None, parameters, scans)
        return ["Car: " + line for line in summary_of(fit)]
    except RobotError as error:
        return [f"No Car: {error}"]
