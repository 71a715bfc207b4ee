"""rosrun mtr_commissioning base_contract: checks if a four-wheel base meets the requirements of the robot's nodes.

It never moves the robot. On the running robot it checks the URDF, the parameters of the base's controller, its topics,
and the reports of nodes that could not start. With --robot-file (and --base-file) only the files are checked, without a
ROS master; the line on masses contains the parameters that drive control needs for that URDF. Checks that need motion
(signs, scales) are in preflight --drive.
Exit status: 0 nothing is bad, 1 something is, 2 it could not be checked.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import os
import pathlib
import sys
from typing import List, Optional

import rospy

from mtr_core import names
from mtr_core.errors import ConfigurationError, range_problem
from mtr_description.base_controller import base_parameters_in
from mtr_description.shipped import urdf_in
from mtr_graph_watch.environment import join_on_loopback
from mtr_graph_watch.master import master_answers
from mtr_motion_check.finding import Finding, exit_code

from ..preflight.base import start_findings
from ..preflight.command_line import (
    CANNOT_CHECK,
    DEFAULT_SECONDS,
    MAX_SECONDS,
    MIN_SECONDS,
    saved,
    shown,
)
from ..preflight.listening import Listener, setup_of_robot
from .description import description_findings
from .interface import limit_findings, topic_rows


def main(arguments: Optional[List[str]] = None) -> int:
    """Check the base; return the exit status."""
    options = parsed(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    try:
        findings = file_findings(options) if options.robot_file else robot_findings(options.seconds)
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        return CANNOT_CHECK
    print(f"{len(findings)} checks, {sum(finding.is_bad for finding in findings)} BAD.")
    return exit_code(findings) if saved(findings, options.json) else CANNOT_CHECK


def parsed(arguments: List[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(prog="base_contract", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot-file", type=pathlib.Path, help="URDF or xacro file; without it the running robot")
    parser.add_argument("--base-file", type=pathlib.Path, help="YAML file with the parameters of the base's controller")
    parser.add_argument("--no-rear-lidar", action="store_true", help="the robot of the file has no rear LiDAR")
    parser.add_argument("--seconds", type=float, default=DEFAULT_SECONDS,
                        help=f"how long to listen, {MIN_SECONDS:.0f} to {MAX_SECONDS:.0f} s ({DEFAULT_SECONDS:.0f})")
    parser.add_argument("--json", type=pathlib.Path, help="file for the findings")
    options = parser.parse_args(arguments)
    problem = range_problem("Option --seconds", options.seconds, MIN_SECONDS, MAX_SECONDS, "s")
    if problem:
        parser.error(problem)
    return options


def file_findings(options: argparse.Namespace) -> List[Finding]:
    """Check the files alone; ConfigurationError if one cannot be read."""
    findings = shown(description_findings(urdf_in(options.robot_file), not options.no_rear_lidar))
    if options.base_file:
        findings += shown(limit_findings(str(options.base_file), base_parameters_in(options.base_file)))
    return findings


def robot_findings(seconds: float) -> List[Finding]:
    """Check the running robot; ConfigurationError without a master."""
    join_on_loopback(os.environ)
    if not master_answers():
        raise ConfigurationError("There is no ROS master; start the robot first (roslaunch mtr_bringup robot.launch), "
                                 "or name files (--robot-file).")
    rospy.init_node("base_contract", anonymous=True, disable_signals=True)
    setup = setup_of_robot()
    found = shown(description_findings(str(rospy.get_param(names.ROBOT_DESCRIPTION, "")), setup.rear_lidar))
    listener = Listener()
    print(f"Listening for {seconds:g} s ...", flush=True)
    record = listener.listen(seconds, setup)
    return found + shown([*start_findings(record), *limit_findings(setup.base_parameters, record.base),
                          *topic_rows(record, setup, wheel_listeners())])


def wheel_listeners() -> List[str]:
    """Return the nodes that subscribe to the wheel command, as listed by the master."""
    _, _, state = rospy.get_master().getSystemState()
    return sorted(dict(state[1]).get(names.WHEEL_COMMAND, []))
