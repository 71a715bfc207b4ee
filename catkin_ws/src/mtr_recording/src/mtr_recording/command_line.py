"""rosrun mtr_recording record [--profile small|full] [--mcap]: records bags of the running robot, bounded in size,
until Ctrl-C.

With --mcap it also writes an MCAP file next to each bag after the recording. The parameters of the nodes are written
next to it (PREFIX.yaml), so that a replay can use them. Topics with other names are remapped as for every node:
/front/scan:=/scan.
Exit status: that of rosbag; 2 if recording is impossible.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import datetime
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
from typing import Any, Callable, Dict, List, Optional

import rospy
import yaml

from mtr_core import names
from mtr_core.errors import RobotError, range_problem
from mtr_core.lockstep.clock import LOCKSTEP_PARAMETER
from mtr_graph_watch.environment import as_around, join_on_loopback
from mtr_graph_watch.master import master_answers

from .bags import decisions_in, messages_in
from .decisions import differences
from .listening import is_listening
from .mcap_file import check_mcap, write_mcap
from .player import RECORDED_IN_LOCKSTEP, Player
from .profiles import DEFAULT_LIMIT_MB, MAX_LIMIT_MB, MIN_LIMIT_MB, PROFILES, CannotRecord, check_room, command_of
from .relay import relay_orders

CANNOT = 2
MIN_RATE, MAX_RATE = 0.05, 20.0
READY_EVERY_S, READY_LIMIT_S = 0.1, 10.0
# Parameters of nodes that are restarted in a replay.
KEPT_PARAMETERS = (names.ROBOT_DESCRIPTION, names.ROBOT_FRAMES, "/localization", "/car_locator", "/state_machine")


def record(arguments: Optional[List[str]] = None) -> int:
    """Record until Ctrl-C; return the exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    options = parsed(rospy.myargv(given))
    join_on_loopback(os.environ)
    try:
        if not master_answers():
            raise CannotRecord("There is no ROS master; start the robot first (roslaunch mtr_bringup robot.launch).")
        if options.mcap:
            check_mcap()
        prefix = options.out / f"{options.profile}_{datetime.datetime.now():%Y-%m-%d_%H-%M-%S}"
        check_room(options.out, options.limit * (2 if options.mcap else 1), shutil.disk_usage(str(options.out)).free)
        keep_parameters(prefix.with_suffix(".yaml"))
    except (RobotError, OSError) as error:
        print(error, file=sys.stderr)
        return CANNOT
    mapped = rospy.names.load_mappings(given)
    command = command_of(options.profile, prefix, options.limit, lambda topic: mapped.get(topic, topic))
    recorder, relay = f"record_{os.getpid()}", f"record_relay_{os.getpid()}"
    rospy.init_node(relay, argv=[], disable_signals=True, disable_rostime=True)
    relay_orders(options.profile, lambda topic: mapped.get(topic, topic))
    status = run([*command, f"__name:={recorder}"], lambda: is_listening(f"/{relay}") and is_listening(f"/{recorder}"),
                 f"Recording {prefix}_*.bag, the newest {options.limit:.0f} MB; Ctrl-C ends it.")
    rospy.signal_shutdown("the recording has ended")
    return status or (written_as_mcap(prefix) if options.mcap else 0)


def written_as_mcap(prefix: pathlib.Path) -> int:
    """Write an MCAP file next to each bag of a recording; return the exit status."""
    # From now on Ctrl-C ends this program, without leaving a file that looks complete.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    try:
        for bag in sorted(prefix.parent.glob(f"{prefix.name}_*.bag")):
            count = write_mcap(bag.with_suffix(".mcap"), messages_in(bag))
            print(f"{bag.with_suffix('.mcap')}: {count} messages.", flush=True)
    except (CannotRecord, OSError) as error:
        print(error, file=sys.stderr)
        return CANNOT
    return 0


def parsed(arguments: List[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(prog="record", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--profile", choices=list(PROFILES), default="small",
                        help="small: decisions and poses; full: sensors too, for a replay (small)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(), help="folder for the bags (this one)")
    parser.add_argument("--limit", type=float, default=None, help="MB on the disk at most, the oldest go (small: "
                        f"{DEFAULT_LIMIT_MB['small']:.0f}, full: {DEFAULT_LIMIT_MB['full']:.0f})")
    parser.add_argument("--mcap", action="store_true", help="write MCAP files beside the bags when it has ended, which "
                        "takes as much room again; needs the Python package mcap")
    options = parser.parse_args(arguments)
    if options.limit is None:
        options.limit = DEFAULT_LIMIT_MB[options.profile]
    problem = range_problem("Option --limit", options.limit, MIN_LIMIT_MB, MAX_LIMIT_MB, "MB")
    if problem:
        parser.error(problem)
    if not options.out.is_dir():
        parser.error(f"{options.out} is no folder; make it, or name another one.")
    return options


def keep_parameters(path: pathlib.Path) -> None:
    """Write the parameters of the replayed nodes, and whether the recorded clock waited for them."""
    kept: Dict[str, Any] = {}
    for name in KEPT_PARAMETERS:
        value = rospy.get_param(name, None)
        if value is not None:
            kept[name.lstrip("/")] = value
    simulated, waiting = rospy.get_param("/use_sim_time", False), rospy.get_param(LOCKSTEP_PARAMETER, False)
    kept[RECORDED_IN_LOCKSTEP.lstrip("/")] = bool(simulated and waiting)
    path.write_text(yaml.safe_dump(kept), encoding="utf-8")


def run(command: List[str], is_ready: Callable[[], bool], sentence: str) -> int:
    """Run a program and return its exit status; on Ctrl-C or at the end of a service, end it and wait until the bag is
    closed.

    Args:
        is_ready: checks if the program is working.
        sentence: printed when it is.
    """
    started: List[subprocess.Popen[bytes]] = []
    asked: List[int] = []

    def end(number: int, _: Any) -> None:
        asked.append(number)
        for process in started:
            process.send_signal(signal.SIGINT)

    # Set before the start, because a Ctrl-C right after it must also end the program.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    # A separate session prevents a second Ctrl-C from the terminal.
    started.append(subprocess.Popen(command, env=as_around(os.environ), start_new_session=True))
    if asked:
        started[0].send_signal(signal.SIGINT)
    # The loop ends if the node dies without connecting.
    until_s = time.monotonic() + READY_LIMIT_S
    while started[0].poll() is None and not is_ready() and time.monotonic() < until_s:
        time.sleep(READY_EVERY_S)
    if started[0].poll() is None:
        print(sentence, flush=True)
    return started[0].wait()


def play(arguments: Optional[List[str]] = None) -> int:
    """rosrun mtr_recording play BAG... [--rate R]: plays the inputs of a recording for localization, Car locator and
    state machine, which replay.launch starts. It is never faster than they follow, so that a busy machine is slower but
    decides the same."""
    parser = argparse.ArgumentParser(prog="play", description=play.__doc__)
    parser.add_argument("bags", type=pathlib.Path, nargs="+", help="files of one recording")
    parser.add_argument("--rate", type=float, default=1.0, help="recorded seconds per second at most (1)")
    parser.add_argument("--recorder", help="node that records what is decided, and is waited for")
    options = parser.parse_args(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    problem = range_problem("Option --rate", options.rate, MIN_RATE, MAX_RATE, "")
    if problem:
        parser.error(problem)
    try:
        rospy.init_node("play")
        rospy.loginfo(Player(options.bags, options.rate, options.recorder).play())
    except RobotError as error:
        print(error, file=sys.stderr)
        return CANNOT
    return 0


def compare(arguments: Optional[List[str]] = None) -> int:
    """rosrun mtr_recording same_decisions RECORDED... --replayed BAG...: exit status 0 if both have the same
    decisions."""
    parser = argparse.ArgumentParser(prog="same_decisions", description=compare.__doc__)
    parser.add_argument("recorded", type=pathlib.Path, nargs="+")
    parser.add_argument("--replayed", type=pathlib.Path, nargs="+", required=True)
    options = parser.parse_args(sys.argv[1:] if arguments is None else arguments)
    try:
        found = differences(decisions_in(options.recorded), decisions_in(options.replayed))
    except RobotError as error:
        print(error, file=sys.stderr)
        return CANNOT
    print("\n".join(found) if found else "The replay decided the same.")
    return int(bool(found))
