"""rosrun mtr_commissioning preflight: checks the running robot and prints ok or BAD, a sentence for each check.

It never moves the robot. With --drive a person drives it by hand while its sensors are compared.
Exit status: 0 nothing is bad, 1 something is, 2 it could not be checked.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from typing import List, Optional

import rospy

from mtr_core import names
from mtr_core.errors import ConfigurationError, range_problem
from mtr_core.liveness import NS
from mtr_core.lockstep import clock
from mtr_description.robot_description import described_robot
from mtr_description.robot_geometry import RobotGeometry
from mtr_description.shipped import shipped_base
from mtr_dispatcher.preflight_report import PreflightItem, parameter_of, report_in, report_of
from mtr_graph_watch.environment import join_on_loopback
from mtr_graph_watch.master import master_answers
from mtr_motion_check.finding import NEEDS_MORE, Finding, bad, exit_code
from mtr_motion_check.judge import MotionJudge, is_finished
from mtr_motion_check.response import response_findings

from .clocks import clock_finding, masters_finding, network_findings
from .expected import Setup
from .frames import DESCRIPTION, lidar_mounts
from .kept_motion import findings_kept
from .listening import Listener, setup_of_robot
from .machine import Machine, machine_findings
from .obedience import obedience_findings
from .report import standing_findings, write
from .wifi import own_stations, wifi_finding

CANNOT_CHECK = 2
MIN_SECONDS, MAX_SECONDS, DEFAULT_SECONDS = 2.0, 60.0, 5.0
# Time limit of the drive, and period of the check for sufficient data.
DRIVE_S, JUDGE_EVERY_S = 20.0, 1.0
PROGRAM_TIMEOUT_S = 5.0
CHRONY = ["chronyc", "-c", "tracking"]


def main(arguments: Optional[List[str]] = None) -> int:
    """Check the robot; return the exit status."""
    options = parsed(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    join_on_loopback(os.environ)
    uri = os.environ.get("ROS_MASTER_URI", "")
    if not master_answers():
        print(f"There is no ROS master at {uri or '(ROS_MASTER_URI is not set)'}; start the robot first "
              "(roslaunch mtr_bringup robot.launch).", file=sys.stderr)
        return CANNOT_CHECK
    rospy.init_node("preflight", anonymous=True, disable_signals=True)
    findings = shown(computer_findings(uri, setup_of_robot()))
    findings += robot_findings(options)
    bad_count = sum(finding.is_bad for finding in findings)
    print(f"{len(findings)} checks, {bad_count} BAD.")
    leave(names.PREFLIGHT_REPORT, findings)
    return exit_code(findings) if saved(findings, options.json) else CANNOT_CHECK


def parsed(arguments: List[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(prog="preflight", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=DEFAULT_SECONDS,
                        help=f"how long to listen, {MIN_SECONDS:.0f} to {MAX_SECONDS:.0f} s ({DEFAULT_SECONDS:.0f})")
    parser.add_argument("--drive", action="store_true",
                        help="compare the sensors while a person drives: forward, back and a turn")
    parser.add_argument("--json", type=pathlib.Path, help="file for the findings")
    options = parser.parse_args(arguments)
    problem = range_problem("Option --seconds", options.seconds, MIN_SECONDS, MAX_SECONDS, "s")
    if problem:
        parser.error(problem)
    return options


def shown(findings: List[Finding]) -> List[Finding]:
    """Print the findings and return them."""
    for finding in findings:
        print(finding.line(), flush=True)
    return findings


def computer_findings(uri: str, setup: Setup) -> List[Finding]:
    """Check clock, network, disk and other parts of the computer."""
    # Bags are started in the home of the user; the robot reports the folders of its nodes.
    machine = Machine(pathlib.Path("/"), [pathlib.Path.home(), *map(pathlib.Path, setup.written_folders)])
    return [*network_findings(os.environ, uri),
            masters_finding(uri, machine.ros_master_ports(), setup.is_simulated),
            clock_finding(said_by(CHRONY), setup.is_simulated), *machine_findings(machine),
            wifi_finding(machine.signal_dbm(), own_stations(said_by))]


def said_by(command: List[str]) -> Optional[str]:
    """Return the output of a program; None if it is not installed, empty if it does not answer."""
    if shutil.which(command[0]) is None:
        return None
    try:
        return subprocess.run(command, check=False, capture_output=True, text=True, timeout=PROGRAM_TIMEOUT_S).stdout
    except (OSError, subprocess.TimeoutExpired):
        return ""


def robot_findings(options: argparse.Namespace) -> List[Finding]:
    """Check the robot's messages, and its motion if requested."""
    setup, found = setup_of_robot(), []
    geometry: Optional[RobotGeometry] = None
    try:
        geometry = described_robot()
    except ConfigurationError as error:
        found = shown([bad(DESCRIPTION, names.ROBOT_DESCRIPTION, str(error))])
    listener = Listener()
    print(f"Listening for {options.seconds:g} s ...", flush=True)
    record = listener.listen(options.seconds, setup)
    found += shown(named(standing_findings(record, setup, geometry, shipped_base()), listener))
    if not options.drive:
        kept = report_in(rospy.get_param(names.PREFLIGHT_MOTION, None))
        return found + shown(findings_kept(kept, clock.steady_ns() * NS))
    moved = shown(named(motion_findings(listener, geometry, setup), listener))
    leave(names.PREFLIGHT_MOTION, moved)
    return found + moved


def named(findings: List[Finding], listener: Listener) -> List[Finding]:
    """Return the findings with the robot's own topic names."""
    return [replace(finding, subject=listener.names.get(finding.subject, finding.subject)) for finding in findings]


def motion_findings(listener: Listener, geometry: Optional[RobotGeometry], setup: Setup) -> List[Finding]:
    """Compare the sensors while a person drives; return the last verdict when no further data is needed."""
    mounts = lidar_mounts(geometry, setup) if geometry else None
    if mounts is None:
        return [bad(DESCRIPTION, names.ROBOT_DESCRIPTION, "Nothing was compared in motion, because it does not say "
                    "where the LiDARs are.")]
    print(f"Drive the robot by hand, forward, back and a turn, and release the dead-man button in motion, within "
          f"{DRIVE_S:.0f} s ...", flush=True)
    # Earlier reasons for stopped wheels no longer apply.
    listener.drive_control.clear()
    judge, end_s = MotionJudge(mounts), time.monotonic() + DRIVE_S
    found: List[Finding] = []
    while time.monotonic() < end_s:
        time.sleep(JUDGE_EVERY_S)
        recording = listener.recording.copy()
        found = judge.findings(recording) + response_findings(recording, setup.reaction_s)
        stopped = obedience_findings(listener.drive_control)
        if stopped:
            return stopped + [finding for finding in found if finding.is_bad and finding.check != NEEDS_MORE]
        if is_finished(found, recording.motion_s()):
            break
    return found


def leave(parameter: str, findings: List[Finding]) -> None:
    """Store the findings at the ROS master until it ends: for the dispatcher, which reports them to the application,
    and for the next preflight."""
    items = tuple(PreflightItem(finding.subject, finding.is_bad, finding.text) for finding in findings)
    try:
        rospy.set_param(parameter, parameter_of(report_of(clock.steady_ns() * NS, items)))
    except (OSError, rospy.ROSException) as error:
        print(f"The Operator's application will not show this: the ROS master does not take it ({error}).",
              file=sys.stderr)


def saved(findings: List[Finding], path: Optional[pathlib.Path]) -> bool:
    """Write the requested file; return False, with a sentence, if it cannot be written."""
    try:
        if path:
            write(findings, path)
    except OSError as error:
        print(f"The findings cannot be written to {path} ({error.strerror}); name a file in a folder that is there.",
              file=sys.stderr)
        return False
    return True
