"""The robot team's commands: pair a laptop, list the paired keys, revoke one."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import datetime
import os
import pathlib
import sys
import time
from typing import Any, Dict, List, Optional

from mtr_core.errors import RobotError
from mtr_proto.keys import fingerprint
from mtr_proto.pairing import PORT, Hello, PairingError, RobotSide, new_code, plain_name

from .authorised_keys import Entry, Role
from .key_folder import FOLDER_NAME, KeyFolder
from .pairing_server import Offer, PairingServer
from .pairing_window import DEFAULT_SECONDS, PairingLimits, PairingWindow

# ZeroMQ writes this address as a star, and bind_address may use the star.
EVERYWHERE = "0.0.0.0"
DONE, NOT_PAIRED, ERROR, INTERRUPTED = 0, 1, 2, 130


def pair(arguments: Optional[List[str]] = None, known: Optional[Dict[str, Any]] = None) -> int:
    """Run `rosrun mtr_dispatcher pair` and return the exit status. known: parameters of the running dispatcher."""
    known = known or {}
    parser = argparse.ArgumentParser(prog="pair",
                                     description="Shows a code; the laptop on which it is typed is paired.")
    parser.add_argument("--role", choices=[role.value for role in Role], default=Role.CONTROLLER.value,
                        help="what the laptop may do, default %(default)s")
    parser.add_argument("--name", help="name of the key's owner; default: what the laptop calls itself")
    parser.add_argument("--seconds", type=float, default=DEFAULT_SECONDS, help="default %(default)g")
    parser.add_argument("--address", default=known.get("bind_address", "127.0.0.1"),
                        help="where to listen; default: the link's address, %(default)s")
    parser.add_argument("--port", type=int, default=PORT, help="TCP port, default %(default)s")
    _add_keys(parser, known)
    options = parser.parse_args(arguments)
    try:
        return _pair(options)
    except (RobotError, PairingError) as error:
        print(error, file=sys.stderr)
        return ERROR
    except KeyboardInterrupt:
        print("Nobody was paired.", file=sys.stderr)
        return INTERRUPTED


def keys(arguments: Optional[List[str]] = None, known: Optional[Dict[str, Any]] = None) -> int:
    """Run `rosrun mtr_dispatcher keys` and return the exit status."""
    parser = argparse.ArgumentParser(prog="keys", description="Lists the paired keys, or revokes one.")
    parser.add_argument("--revoke", metavar="NAME", help="the key of this owner is accepted no more, at once")
    _add_keys(parser, known or {})
    options = parser.parse_args(arguments)
    try:
        return _keys(options)
    except RobotError as error:
        print(error, file=sys.stderr)
        return ERROR


def default_folder() -> pathlib.Path:
    """Return the default key folder within ROS_HOME, where ROS stores the data of this computer."""
    return pathlib.Path(os.environ.get("ROS_HOME") or pathlib.Path.home() / ".ros") / FOLDER_NAME


def _add_keys(parser: argparse.ArgumentParser, known: Dict[str, Any]) -> None:
    parser.add_argument("--keys", type=pathlib.Path, metavar="FOLDER",
                        default=pathlib.Path(known.get("key_folder") or default_folder()),
                        help="the dispatcher's key_folder; default %(default)s")


def _pair(options: argparse.Namespace) -> int:
    folder, role = KeyFolder(options.keys), Role(options.role)
    own, code = folder.own_keys(), new_code()
    # A missing prerequisite is reported now, not when a laptop connects.
    RobotSide(code, own.public)

    def keep(hello: Hello) -> None:
        name = plain_name(options.name) if options.name else hello.name
        today = datetime.date.today().isoformat()
        folder.change(lambda keys: keys.with_entry(Entry(name, role, today, hello.public_key)))

    limits = PairingLimits(options.seconds)
    server = PairingServer(Offer(code, own, role), keep, _say)
    port = server.listen(options.address.replace("*", EVERYWHERE), options.port)
    _show(code, options.address, port)
    _say(f"It holds for {limits.seconds:g} s, and makes the laptop a {role.value}.")
    window = PairingWindow(limits, time.monotonic())
    hello = server.run(window)
    if hello is None:
        print(window.why_closed(), file=sys.stderr)
        return NOT_PAIRED
    entry = folder.authorised().of(hello.public_key)
    _say(f"Paired: {entry.name if entry else hello.name}, {role.value}, key {fingerprint(hello.public_key)}.")
    return DONE


def _show(code: str, address: str, port: int) -> None:
    where = "ADDRESS" if address in ("*", EVERYWHERE) else address
    _say(f"Code: {code[:3]} {code[3:]}")
    _say(f"Type it on the laptop: in the connection window, or mtr-operator pair {where}"
         f"{'' if port == PORT else f' --port {port}'}")


def _keys(options: argparse.Namespace) -> int:
    folder = KeyFolder(options.keys)
    if options.revoke is not None:
        folder.change(lambda keys: keys.without(options.revoke))
        _say(f"The key of {options.revoke} is revoked.")
        return DONE
    found = folder.authorised()
    if folder.distrust:
        print(folder.distrust, file=sys.stderr)
        return ERROR
    _say(f"This robot's key: {fingerprint(folder.own_keys().public.decode('ascii'))}")
    for line in found.lines() or ("No key is paired.",):
        _say(line)
    return DONE


def _say(line: str) -> None:
    print(line, flush=True)
