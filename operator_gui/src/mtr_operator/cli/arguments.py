"""Command line of the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import pathlib
import sys
from typing import NoReturn

from mtr_operator import __version__
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.geometry.area import corners_from_text
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.scenarios import SCENARIOS

from .exit_codes import EXIT_USAGE


class _Parser(argparse.ArgumentParser):
    """Parser that reports an error in one line."""

    def error(self, message: str) -> NoReturn:
        """See ArgumentParser."""
        print(f"{message[:1].upper()}{message[1:]}; {self.prog} --help lists what there is.", file=sys.stderr)
        sys.exit(EXIT_USAGE)


def argument_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    parser = _Parser(prog="mtr-operator", description="Measures where a car's remote key works.")
    parser.add_argument("--version", action="version", version=__version__)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    _add_window(commands.add_parser("window", help="open the window; so does no command at all"))
    _add_params(commands.add_parser("params", help="list the parameters of a scenario"))
    _add_plan(commands.add_parser("plan", help="say what a test would take and tell, without robot and Car"))
    _add_run(commands.add_parser("run", help="run a test"))
    _add_check(commands.add_parser("check", help="look whether the Car still stands where it was measured"))
    _add_service(commands.add_parser("service", help="disable wheels, lift and servos for work on the robot"))
    _add_demo(commands.add_parser("demo", help="run a test on a robot and a Car inside the application; needs no file"))
    _add_history(commands.add_parser("history", help="list the tests that were measured before"))
    _add_compare(commands.add_parser("compare", help="compare two tests, distance by distance, with intervals"))
    _add_replay(commands.add_parser("replay", help="compute the distances of a recorded test anew"))
    _add_bundle(commands.add_parser("bundle", help="write the signed evidence of a test into one file"))
    _add_verify(commands.add_parser("verify", help="say whether bundles are as they were signed, by whom and when"))
    _add_pair(commands.add_parser("pair", help="pair this computer with a robot that shows a code"))
    _add_keys(commands.add_parser("keys", help="list this computer's key and the robots that it is paired with"))
    _add_learn(commands.add_parser("learn", help="learn how a Car's bus tells its locks, and write its profile"))
    _add_try(commands.add_parser("try", help="try a car's profile on a simulated Car that speaks its frames"))
    _add_doctor(commands.add_parser("doctor", help="say what this computer lacks, or with --robot how a robot is"))
    return parser


def _add_window(parser: argparse.ArgumentParser) -> None:
    parser.description = "Opens the connection window, filled in with what is given here."
    parser.add_argument("--robot", metavar="HOST", help="address of the robot, or simulated for a substitute")
    parser.add_argument("--subscriber-port", type=_whole_number, metavar="N", help="TCP port of Status")
    parser.add_argument("--publisher-port", type=_whole_number, metavar="N", help="TCP port of Command")
    _add_unencrypted(parser)
    parser.add_argument("--can-interface", metavar="NAME", help="python-can interface, or simulated for a substitute")
    parser.add_argument("--can-channel", metavar="NAME", help="channel or device of the adapter")
    parser.add_argument("--can-bitrate", type=_whole_number, metavar="N", help="bit/s")
    _add_can_mode(parser)
    parser.add_argument("--car-profile", metavar="NAME_OR_PATH", help="how the Car's bus tells its lock state")
    _add_car_seed(parser, default=None)


def _add_params(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", choices=list(SCENARIOS), help="one of %(choices)s", metavar="SCENARIO")
    parser.add_argument("--write", type=pathlib.Path, metavar="FILE",
                        help="write them into a new parameter file that run and plan take, to be edited")


def _add_plan(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", choices=list(SCENARIOS), help="one of %(choices)s", metavar="SCENARIO")
    parser.add_argument("--params", type=pathlib.Path, required=True, metavar="FILE", help="parameters, YAML or JSON")
    parser.add_argument("--limits", type=pathlib.Path, metavar="FILE", help="limits that have to suit the test, YAML")
    parser.add_argument("--car-profile", metavar="NAME_OR_PATH",
                        help="how the Car's bus tells its lock state; default: a message every 0.2 s")


def _add_run(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scenario", choices=list(SCENARIOS), help="one of %(choices)s", metavar="SCENARIO")
    parser.add_argument("--params", type=pathlib.Path, required=True, metavar="FILE", help="parameters, YAML or JSON")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="DIR", help="folder for the results")
    parser.add_argument("--continue", dest="continued", type=pathlib.Path, metavar="FILE",
                        help="progress.json of an interrupted test to go on with")
    parser.add_argument("--limits", type=pathlib.Path, metavar="FILE",
                        help="limits that the lines are judged by, YAML; exit code 3 is fail, 4 inconclusive")
    parser.add_argument("--calibration", type=pathlib.Path, metavar="FILE",
                        help="calibration record of the robot, YAML; default: that of the design")
    parser.add_argument("--identity", type=pathlib.Path, metavar="FILE",
                        help="car, key, operator, place, notes, photos and equipment of this test, YAML")
    parser.add_argument("--laboratory", type=pathlib.Path, metavar="FILE",
                        help="what the laboratory requires of each identity, YAML; default: laboratory.yaml beside the "
                             "window's settings, if there is one")
    parser.add_argument("--test-area", type=_corners, metavar="CORNERS",
                        help="area that the robot does not leave, as 'x y; x y; ...' in m, where it stood at its start "
                             "(x ahead, y left), or the path of a file with them; default: the one that the robot has")
    parser.add_argument("--bundle", action="store_true", help="write the signed evidence of the test into DIR, too")
    _add_robot(parser)
    car = parser.add_argument_group("Car")
    _add_adapter(car)
    car.add_argument("--can-bus", action="append", default=[], metavar="NAME=INTERFACE:CHANNEL:BITRATE",
                     help="adapter of a further bus that the profile names; may be given more than once")
    car.add_argument("--car-profile", default="mtr_demo_car", metavar="NAME_OR_PATH",
                     help="how the Car's bus tells its lock state, default %(default)s")
    car.add_argument("--simulated-car", action="store_true", help="use a substitute inside the application")
    _add_car_seed(car)
    car.add_argument("--simulated-key-sleep", type=_number, default=0.0, metavar="S",
                     help="rest in s after which the substitute's key sleeps, 0 to 3600; default 0: never")
    car.add_argument("--simulated-extender", type=_number, default=0.0, metavar="M",
                     help="by how many m the substitute's extender has the key be nearer while it is switched on, 0 to "
                          "100; default 0: not at all")
    car.add_argument("--can-log", type=pathlib.Path, metavar="FILE",
                     help="play this log of a bus as the Car, at the speed of the robot's clock")
    car.add_argument("--phone-feed", metavar="FEED",
                     help="what tells the distance of a phone, for digital_key: tcp:HOST:PORT, serial:DEVICE:BAUD or "
                          "simulated:NAME=VALUE,...; default: what the profile declares")
    car.add_argument("--can-log-format", choices=("blf", "asc", "trc", "mf4", "none"), default="blf", metavar="KIND",
                     help="kind of the log that is kept of the bus: %(choices)s; default %(default)s")


def _add_adapter(car: argparse._ActionsContainer) -> None:
    car.add_argument("--can-interface", default="pcan", metavar="NAME",
                     help="python-can interface: pcan, socketcan, slcan, ...; default %(default)s")
    car.add_argument("--can-channel", default="PCAN_USBBUS1", metavar="NAME",
                     help="channel or device of the adapter, default %(default)s")
    car.add_argument("--can-bitrate", type=_whole_number, default=500000, metavar="N",
                     help="bit/s, default %(default)s")
    _add_can_mode(car)


def _add_learn(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Asks you to lock and unlock the Car with its own key, listens to its bus meanwhile, and "
                          "writes the message and signal that followed. Nothing is sent.")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FILE",
                        help="profile to be written, such as my_car.yaml; its database goes beside it")
    parser.add_argument("--database", type=pathlib.Path, metavar="FILE",
                        help="a CAN database of the Car, whose message and signal the profile names; without it the "
                             "profile gets one of its own")
    parser.add_argument("--prompts", type=_whole_number, default=10, metavar="N",
                        help="how often you are asked, an even number from 4 to 40, default %(default)s")
    _add_adapter(parser)


def _add_try(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Runs an Autolock on a simulated Car that speaks the frames of the profile, on a bus inside "
                          "this computer. Exit code 0: every change was understood; 3: not; 2: the profile is wrong.")
    parser.add_argument("profiles", nargs="+", metavar="NAME_OR_PATH", help="profile of a car")
    parser.add_argument("--databases", type=pathlib.Path, metavar="DIR",
                        help="folder of the profiles' CAN databases; default: beside the profile, then the folder that "
                             "MTR_CAR_DATABASES names, as for every command")
    _add_seed(parser)
    _add_car_seed(parser)


def _add_demo(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Runs a test with usual parameters on a substitute of the robot and a simulated Car, as fast "
                          "as the computer can.")
    parser.add_argument("scenario", nargs="?", choices=list(SCENARIOS), default="autolock", metavar="SCENARIO",
                        help="one of %(choices)s, default %(default)s")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR",
                        help="folder for the results; default: a new one in the folder of results")
    parser.add_argument("--limits", type=pathlib.Path, metavar="FILE", help="limits that the lines are judged by, YAML")
    _add_seed(parser)
    _add_car_seed(parser)
    parser.set_defaults(phone_feed=None)
    parser.set_defaults(can_log=None, can_log_format="blf", bundle=False, test_area=None)
    parser.set_defaults(params=None, continued=None, calibration=None, identity=None, laboratory=None,
                        simulated_robot=True, simulated_car=True, simulated_key_sleep=0.0,
                        simulated_extender=0.0)


def _add_history(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Lists tests, newest first, in which each of the words occurs; files that cannot be read are "
                          "named on stderr.")
    parser.add_argument("words", nargs="*", metavar="WORD", help="such as a VIN, a key, a day, an operator")
    parser.add_argument("--folder", action="append", type=pathlib.Path, metavar="DIR",
                        help="where tests are; may be given more than once; default: the window's folders")
    for name in ("car", "key", "verdict"):
        parser.add_argument(f"--{name}", default="", metavar="TEXT", help=f"only tests of exactly this {name}")
    parser.add_argument("--json", action="store_true", help="print JSON")


def _add_compare(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Compares two tests of one scenario. A distance is called different only where the 95 % "
                          "interval of its difference does not hold zero.")
    for name in ("first", "second"):
        parser.add_argument(name, type=pathlib.Path, metavar=name.upper(), help="progress.json, or the folder with it")
    parser.add_argument("--json", action="store_true", help="print JSON")


def _add_replay(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Computes all distances of a test anew, from the log of the Car's bus, the poses and the "
                          "profile, and says what would change. Exit code 0: nothing, to 0.1 mm; 3: something.")
    parser.add_argument("results", type=pathlib.Path, metavar="RESULTS",
                        help="progress.json, or the folder with it; the recording is beside it. Or a bundle")
    parser.add_argument("--car-profile", metavar="NAME_OR_PATH", help="a mended profile; default: that of the test")
    parser.add_argument("--can-log", type=pathlib.Path, metavar="FILE",
                        help="another log of the same bus and time, instead of the recorded one")
    parser.add_argument("--recording", type=pathlib.Path, metavar="DIR",
                        help="folder of the recording; default: beside the progress file")
    parser.add_argument("--json", action="store_true", help="print JSON")


def _add_bundle(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=pathlib.Path, metavar="RESULTS", help="progress.json, or the folder with it")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="default: beside it, named as its folder")


def _add_verify(parser: argparse.ArgumentParser) -> None:
    parser.description = "Exit code 0: all are intact; 3: something is not, and is named on stderr."
    parser.add_argument("bundles", nargs="+", type=pathlib.Path, metavar="BUNDLE", help="NAME.mtr.zip, or it unpacked")
    parser.add_argument("--key", metavar="HEX", help="public key that has to have signed them")


def _add_pair(parser: argparse.ArgumentParser) -> None:
    parser.description = "The robot shows the code after `rosrun mtr_dispatcher pair`, for two minutes."
    parser.add_argument("host", metavar="HOST", help="address of the robot")
    parser.add_argument("--port", type=_whole_number, default=3335, metavar="N",
                        help="TCP port of pairing, default %(default)s")
    parser.add_argument("--name", metavar="TEXT", help="what the robot calls this computer; default: user@computer")
    parser.add_argument("--code", metavar="DIGITS", help="the code; without it it is asked for")


def _add_keys(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--forget", metavar="HOST", help="forget the robot at this address")


def _add_unencrypted(parser: argparse._ActionsContainer) -> None:
    parser.add_argument("--unencrypted", action="store_true", default=None,
                        help="without encryption, where the robot allows it too: whoever is in its network can move it")


def _add_can_mode(parser: argparse._ActionsContainer) -> None:
    parser.add_argument("--can-data-bitrate", type=_whole_number, metavar="N",
                        help="bit/s of CAN FD data; without it classic CAN")
    parser.add_argument("--can-normal", action="store_true", default=None,
                        help="take part in the bus, for a bench of one node; without it the adapter only listens, and "
                             "sends nothing, not even an acknowledge")


def _add_check(parser: argparse.ArgumentParser) -> None:
    _add_robot(parser)


def _add_service(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Service mode: enter disables wheels, lift and servos at once and over restarts. It ends "
                          "when both sides release it within a minute: this command with leave, and on the robot "
                          "rosrun mtr_dispatcher service_mode release.")
    parser.add_argument("order", choices=["enter", "leave", "show"], help="one of %(choices)s")
    _add_robot(parser)


def _add_doctor(parser: argparse.ArgumentParser) -> None:
    parser.description = ("Says what this computer lacks to run tests; exit code 2 when something is missing. With "
                          "--robot it looks at a robot instead, without a Car, and sends it nothing; exit code 0 when "
                          "a test could begin, else 1.")
    parser.add_argument("--robot", metavar="HOST", help="look at this robot, or at a simulated one")
    _add_ports(parser)
    _add_unencrypted(parser)


def _add_ports(robot: argparse._ActionsContainer) -> None:
    robot.add_argument("--subscriber-port", type=_whole_number, default=3334, metavar="N",
                       help="TCP port of Status, default %(default)s")
    robot.add_argument("--publisher-port", type=_whole_number, default=3333, metavar="N",
                       help="TCP port of Command, default %(default)s")


def _add_robot(parser: argparse.ArgumentParser) -> None:
    robot = parser.add_argument_group("robot")
    robot.add_argument("--robot", default="127.0.0.1", metavar="HOST", help="address, default %(default)s")
    _add_ports(robot)
    _add_unencrypted(robot)
    robot.add_argument("--simulated-robot", action="store_true", help="use a substitute inside the application")
    _add_seed(parser)


def _add_seed(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seed", type=_whole_number, default=1, metavar="N",
                        help="of chance: the substitutes' noise and misses; another seed is another test at the same "
                             "Car, default %(default)s")


def _add_car_seed(car: argparse._ActionsContainer, default: int | None = 1) -> None:
    car.add_argument("--car-seed", type=_whole_number, default=default, metavar="N",
                     help="of the substitute of the Car: another one is another Car with ranges of its own, whatever "
                          "--seed is; default 1")


def _corners(text: str) -> tuple[Point, ...]:
    path = pathlib.Path(text)
    try:
        return corners_from_text(path.read_text(encoding="utf-8").replace("\n", ";") if path.is_file() else text)
    except (InvalidParameter, OSError, UnicodeDecodeError) as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None


def _whole_number(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number") from None
