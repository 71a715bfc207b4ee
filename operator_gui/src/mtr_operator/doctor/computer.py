"""Checks of the computer itself: packages, display, drivers and permissions of CAN adapters.

Only the standard library is imported, because this module reports which of the other packages are missing.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import glob
import importlib
import importlib.util
import os
import pathlib
import sys
from dataclasses import dataclass, field
from typing import Callable, Iterator, Mapping

from mtr_operator.station.checks.finding import State

from .finding import Finding

# Modules by the package that provides them, except the robot interface package, which is not on package indexes.
PACKAGES = {"zmq": "pyzmq", "google.protobuf": "protobuf", "can": "python-can", "cantools": "cantools",
            "serial": "pyserial", "numpy": "numpy", "scipy": "scipy", "matplotlib": "matplotlib",
            "uncertainties": "uncertainties", "yaml": "pyyaml", "tqdm": "tqdm", "platformdirs": "platformdirs",
            "nacl": "pynacl"}
_SERIAL_PORTS = ("dev/ttyACM*", "dev/ttyUSB*")
_NETWORKS = "sys/class/net/*can*"
_DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
# Qt platforms whose windows need a display; the first one lets Qt choose.
_NEEDS_DISPLAY = ("", "xcb", "wayland")


def _is_installed(module: str) -> bool:
    try:
        return importlib.util.find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def _import_problem(module: str) -> str:
    """Return why an installed module cannot be imported; empty if it can."""
    try:
        importlib.import_module(module)
    except ImportError as error:
        return " ".join(str(error).split())
    return ""


def _may_use(path: str) -> bool:
    return os.access(path, os.R_OK | os.W_OK)


@dataclass(frozen=True)
class Computer:
    """Access to the computer. root: folder of the devices. is_installed, may_use: of a module, of a device.

    import_problem: of an installed module; empty without one.
    """

    environment: Mapping[str, str] = field(default_factory=lambda: os.environ)
    platform: str = sys.platform
    root: pathlib.Path = pathlib.Path("/")
    is_installed: Callable[[str], bool] = _is_installed
    may_use: Callable[[str], bool] = _may_use
    import_problem: Callable[[str], str] = _import_problem


def computer_findings(computer: Computer) -> Iterator[Finding]:
    """Yield the findings in the order in which they must be fixed."""
    yield from _packages(computer)
    yield _display(computer)
    yield from _adapters(computer)


def display_problem(environment: Mapping[str, str], platform: str) -> str:
    """Return a sentence why no window can open; empty if one can. Qt aborts the process if the display is missing."""
    wanted = environment.get("QT_QPA_PLATFORM", "").partition(":")[0]
    if platform != "linux" or wanted not in _NEEDS_DISPLAY or any(environment.get(name) for name in _DISPLAYS):
        return ""
    return ("There is no display for the window (neither DISPLAY nor WAYLAND_DISPLAY is set); start it on the laptop's "
            "desktop, or use the command run.")


def _packages(computer: Computer) -> Iterator[Finding]:
    missing = [package for module, package in PACKAGES.items() if not computer.is_installed(module)]
    if missing:
        yield Finding("packages", State.BAD, f"Not installed: {', '.join(missing)}; pip install them.")
    else:
        yield Finding("packages", State.GOOD, "All that a test needs are installed.")
    if not computer.is_installed("mtr_proto"):
        yield Finding("contract", State.BAD, "The package mtr_proto, the contract with the robot, is not installed;"
                      " pip install the folder proto of the project.")
    elif problem := computer.import_problem("mtr_proto.robot_link_pb2"):
        yield Finding("contract", State.BAD, f"The package mtr_proto, the contract with the robot, does not work "
                      f"with the protobuf that is installed ({problem}); pip install mtr_proto again, with what it "
                      "requires.")
    if not computer.is_installed("PyQt5"):
        yield Finding("window", State.BAD, "The window needs PyQt5, which is not installed; pip install PyQt5, or "
                      "use the command run.")


def _display(computer: Computer) -> Finding:
    problem = display_problem(computer.environment, computer.platform)
    return Finding("display", State.BAD if problem else State.GOOD, problem or "The window can open.")


def _adapters(computer: Computer) -> Iterator[Finding]:
    if computer.platform != "linux":
        yield Finding("CAN adapter", State.NOTE, "Its driver comes from its vendor; whether it works is seen when the "
                      "window connects.")
        return
    ports = sorted(path for pattern in _SERIAL_PORTS for path in glob.glob(str(computer.root / pattern)))
    for path in ports:
        if computer.may_use(path):
            yield Finding("serial port", State.GOOD, f"{path} can be used.")
        else:
            yield Finding("serial port", State.BAD, f"{path} is there, and you may not use it; sudo usermod -aG "
                          "dialout $USER, then log in again.")
    networks = [pathlib.Path(path) for path in sorted(glob.glob(str(computer.root / _NETWORKS)))]
    for network in networks:
        yield _network(network)
    if not ports and not networks:
        yield Finding("CAN adapter", State.NOTE, "None is plugged in: no serial port and no CAN network; without one "
                      "only the simulated Car can be tested.")


def _network(network: pathlib.Path) -> Finding:
    try:
        state = (network / "operstate").read_text(encoding="utf-8").strip()
    except OSError:
        state = "unknown"
    if state == "down":
        return Finding("CAN network", State.BAD, f"{network.name} is down; sudo ip link set {network.name} up type "
                       "can bitrate 500000, with the Car's bit rate.")
    return Finding("CAN network", State.GOOD, f"{network.name} is up.")
