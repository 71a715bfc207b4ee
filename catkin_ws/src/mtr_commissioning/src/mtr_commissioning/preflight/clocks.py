"""Checks the synchronisation of this computer's clock, the address of the ROS master, and that it is the only one."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Mapping, NamedTuple, Optional, Sequence
from urllib.parse import urlparse

from mtr_motion_check.finding import Finding, bad, good

CLOCK, MASTER, MASTERS = "clock.synchronised", "ros.network", "ros.masters"
# The laptop compares the robot's times with the Car's bus. It estimates the offset itself, but a clock that is being
# adjusted changes it. Chrony on one Wi-Fi hop keeps a few ms.
MAX_OFFSET_S = 0.02
# Fields of `chronyc -c tracking`, by chronyc(1): reference, name of the source, current offset in s, leap status.
REFERENCE, SOURCE, OFFSET, LEAP = 0, 1, 4, 13
# Reference of a clock that is its own source (`local stratum` of chrony.conf).
OWN_CLOCK = "7F7F0101"
NOT_SYNCHRONISED = "Not synchronised"
LOOPBACK = ("localhost", "127.0.0.1", "::1")


class Tracking(NamedTuple):
    """State of this computer's clock by chrony; the source is empty if it is the clock itself."""

    source: str
    offset_s: float
    is_synchronised: bool


def tracking_in(text: str) -> Optional[Tracking]:
    """Parse the output of `chronyc -c tracking`; None for other output, for example if chronyd is not running."""
    fields = text.strip().split(",")
    try:
        source = "" if fields[REFERENCE] == OWN_CLOCK else fields[SOURCE]
        return Tracking(source, float(fields[OFFSET]), fields[LEAP] != NOT_SYNCHRONISED)
    except (IndexError, ValueError):
        return None


def clock_finding(output: Optional[str], is_simulated: bool) -> Finding:
    """Check the clock.

    Args:
        output: of `chronyc -c tracking`; None without chrony.
        is_simulated: a missing chrony is acceptable.
    """
    tracking = tracking_in(output) if output is not None else None
    if tracking is None:
        what = "Chrony is not installed" if output is None else "Chrony does not run"
        if is_simulated:
            return good(CLOCK, "clock", f"{what}; a simulation does without.")
        return bad(CLOCK, "clock", f"{what}, so nobody knows this clock's offset, allowed is "
                   f"{1e3 * MAX_OFFSET_S:.0f} ms: install and start it on robot and laptop (apt install chrony).", None,
                   1e3 * MAX_OFFSET_S, unit="ms")
    offset_ms, limit_ms = 1e3 * tracking.offset_s, 1e3 * MAX_OFFSET_S
    if not tracking.is_synchronised:
        return bad(CLOCK, "clock", f"Chrony follows no source, allowed is an offset of {limit_ms:.0f} ms to one: name "
                   "the laptop or an NTP server in /etc/chrony/chrony.conf.", None, limit_ms, unit="ms")
    if not tracking.source:
        return good(CLOCK, "clock", "It follows no other and is offered to the laptops, as in a Wi-Fi of the robot's "
                    "own.")
    if abs(offset_ms) > limit_ms:
        return bad(CLOCK, "clock", f"It is {offset_ms:+.1f} ms off {tracking.source}, allowed is {limit_ms:.0f} ms: "
                   "wait until chrony has set it, or run `chronyc makestep` while the robot stands.",
                   offset_ms, limit_ms, unit="ms")
    return good(CLOCK, "clock", f"It is {offset_ms:+.1f} ms off {tracking.source}.", offset_ms, limit_ms, unit="ms")


def masters_finding(master_uri: str, ports: Sequence[int], is_simulated: bool) -> Finding:
    """Check the ROS masters on this computer; masters on other computers are not visible.

    Args:
        ports: of the masters.
        is_simulated: several simulations may run in parallel.
    """
    if len(ports) < 2 or is_simulated:
        return good(MASTERS, "ROS masters", f"{len(ports)} on this computer.", len(ports), 1)
    others = ", ".join(str(port) for port in ports if port != urlparse(master_uri).port)
    return bad(MASTERS, "ROS masters", f"{len(ports)} run on this computer, allowed is 1: beside {master_uri} one on "
               f"port {others}, whose nodes neither see this robot's nor are seen; start the base's service and the "
               "robot with the same ROS_MASTER_URI, the base's first.", len(ports), 1)


def network_findings(environment: Mapping[str, str], master_uri: str) -> List[Finding]:
    """Check the master's address, and this computer's name for nodes on other computers."""
    host = urlparse(master_uri).hostname or ""
    own = environment.get("ROS_IP") or environment.get("ROS_HOSTNAME") or ""
    if host in LOOPBACK:
        return [good(MASTER, "ROS master", f"It is on this computer ({master_uri}).")]
    if not own:
        return [bad(MASTER, "ROS master", f"It is at {master_uri}, and neither ROS_IP nor ROS_HOSTNAME is set, 1 is "
                    "needed: set ROS_IP to this computer's address, else other nodes may not find it.")]
    return [good(MASTER, "ROS master", f"It is at {master_uri}, not on the loopback interface; this computer is known "
                 f"as {own}. Nodes of another master are not seen.")]
