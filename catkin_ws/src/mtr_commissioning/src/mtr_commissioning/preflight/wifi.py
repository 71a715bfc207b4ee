"""Reception of the robot's Wi-Fi: from its access point, or from the laptops in its own network."""
# SPDX-License-Identifier: Apache-2.0
import re
from typing import Callable, List, NamedTuple, Optional, Tuple

from mtr_motion_check.finding import Finding, bad, good

WIFI = "machine.wifi"
# 802.11 at its lowest rates receives down to about -82 dBm; 7 dB are reserved for the robot's rotation.
MIN_SIGNAL_DBM = -75.0
# An application sends several times a second; a client that is silent for longer does not operate the robot now.
PRESENT_S = 10.0
INTERFACES = ["iw", "dev"]


class Station(NamedTuple):
    """Client of the robot's own Wi-Fi, from `iw dev INTERFACE station dump`; a missing level is None."""

    address: str
    silent_s: float
    level_dbm: Optional[float]


def access_points_in(text: str) -> List[str]:
    """Return interfaces that are an access point, from the output of `iw dev`."""
    blocks = re.findall(r"^\s*Interface (\S+)\n((?:(?!^\s*Interface ).*\n?)*)", text, re.MULTILINE)
    return [name for name, block in blocks if re.search(r"^\s*type AP\s*$", block, re.MULTILINE)]


def stations_in(text: str) -> List[Station]:
    """Parse the output of `iw dev INTERFACE station dump`."""
    found = []
    for address, block in re.findall(r"^Station (\S+)[^\n]*\n((?:(?!^Station ).*\n?)*)", text, re.MULTILINE):
        silent, level = (re.search(rf"^\s*{name}:\s*(-?\d+)", block, re.MULTILINE) for name in (
            "inactive time", "signal"))
        found.append(Station(address, 1e-3 * float(silent[1]) if silent else 0.0, float(level[1]) if level else None))
    return found


def own_stations(said_by: Callable[[List[str]], Optional[str]]) -> Optional[List[Station]]:
    """Return the clients of the robot's own Wi-Fi; None without a network of its own, or if it is unknown.

    said_by: output of a program, None if it is not installed.
    """
    names = access_points_in(said_by(INTERFACES) or "")
    if not names:
        return None
    return [station for name in names for station in stations_in(said_by(["iw", "dev", name, "station", "dump"]) or "")]


def wifi_finding(signal: Optional[Tuple[str, float]], stations: Optional[List[Station]]) -> Finding:
    """Check the robot's own Wi-Fi if it has one, else its connection.

    signal: interface and level of the connection in dBm, None without one; stations: as own_stations.
    """
    if stations is not None:
        return _own_finding(stations)
    if signal is None:
        return good(WIFI, "Wi-Fi", "No connection to an access point; a cable is not judged.")
    name, level = signal
    return _finding(f"{name} receives {level:.0f} dBm", level,
                    "bring the access point nearer, or let the robot be one itself.")


def _own_finding(stations: List[Station]) -> Finding:
    heard = [(station.level_dbm, station.address) for station in stations
             if station.silent_s <= PRESENT_S and station.level_dbm is not None]
    if not heard:
        return good(WIFI, "Wi-Fi", "The robot's own, in which no laptop is heard now.")
    level, address = min(heard)
    return _finding(f"The robot's own hears {address} with {level:.0f} dBm, the weakest of {len(heard)}", level,
                    "bring the laptop nearer, or raise it above what stands between.")


def _finding(text: str, level: float, remedy: str) -> Finding:
    if level >= MIN_SIGNAL_DBM:
        return good(WIFI, "Wi-Fi", f"{text}.", level, MIN_SIGNAL_DBM, unit="dBm")
    return bad(WIFI, "Wi-Fi", f"{text}, at least {MIN_SIGNAL_DBM:.0f} dBm are needed: {remedy}", level, MIN_SIGNAL_DBM,
               unit="dBm")
