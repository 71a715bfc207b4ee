"""Checks of a robot by a read-only application: nothing is sent to it, and its controller keeps control.

The findings that prevent a test are the same as in the window, see station/checks.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from typing import Callable, Iterator

from mtr_operator import __version__
from mtr_operator.domain.absent_car import NO_ADAPTER
from mtr_operator.domain.exchange.exchange import MAX_BLIND_S
from mtr_operator.domain.ports import LockState, RobotLink
from mtr_operator.domain.robot_status import EmergencyStop, RobotStatus
from mtr_operator.station.checks.check_texts import check_advice, check_text, check_title
from mtr_operator.station.checks.checklist import UNSEEN, Facts, checklist
from mtr_operator.station.checks.finding import Check, Item, State
from mtr_operator.station.checks.finding import Finding as Found
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Mailbox

from .finding import Finding

# A robot reports its preflight once a second, and lets another application take over after 3 s of silence.
LISTEN_S = 3.0
_POLL_S = 0.1
# Checks of Car, laptop and selected test, which do not concern a robot.
_NOT_OF_ROBOT = (Check.WAY, *UNSEEN, Check.BUS, Check.LOCKS, Check.SIGNALS, Check.CLOCK, Check.KEY,
                 Check.DISK, Check.LIMITS)
# After twice this time no motion command is sent: the robot would stop again and again.
_LONG_GAP_S = MAX_BLIND_S / 2
_MS_PER_S = 1000.0


@dataclass(frozen=True)
class Heard:
    """Received data. robot: newest snapshot, None without any. silent_s: time since it. longest_gap_s: between two
    Statuses or after the last one; count: of Statuses; lost: in transit. is_abandoned: the controlling application was
    silent all the time, so another one can take over."""

    robot: RobotSnapshot | None
    silent_s: float
    longest_gap_s: float
    count: int
    lost: int
    is_abandoned: bool = False


def listen(link: RobotLink, listen_s: float, clock: Callable[[], float] = time.monotonic) -> Heard:
    """Receive Statuses over a connected link without answering. clock: wall time in s."""
    mailbox = Mailbox()
    begun_s = newest_s = clock()
    count, gaps_s, is_abandoned = 0, [0.0], True
    while clock() - begun_s < listen_s:
        status = link.next_status(_POLL_S)
        if status is None:
            continue
        now_s = clock()
        # The time before the first one depends on the robot's period and the subscription.
        gaps_s += [now_s - newest_s] if count else []
        newest_s, count = now_s, count + 1
        is_abandoned = is_abandoned and status.is_abandoned
        mailbox.put_robot(RobotSnapshot(status, LockState.UNKNOWN, NO_ADAPTER, is_secret=link.is_secret,
                                        is_exposed=link.is_exposed))
    silent_s = clock() - newest_s
    return Heard(mailbox.take().robot, silent_s, max(*gaps_s, silent_s), count, link.statistics.lost, is_abandoned)


def robot_items(heard: Heard) -> tuple[Item, ...]:
    """Return the checklist's items of the robot, as in the window."""
    robot = heard.robot
    if robot is not None and heard.is_abandoned:
        robot = replace(robot, status=replace(robot.status, controlled_by_other=False))
    return tuple(item for item in checklist(Facts(robot, heard.silent_s))
                 if item.check not in _NOT_OF_ROBOT and item.finding is not Found.UNHEARD)


def robot_sentences(heard: Heard, round_trip_s: float) -> Iterator[Finding]:
    """Yield a finding for each part of the robot; round_trip_s: of a connection, NaN without a network."""
    for item in robot_items(heard):
        yield Finding(check_title(item.check), item.state, f"{check_text(item)} {check_advice(item)}".rstrip())
        # The first one is in the sentence above.
        further = [sentence for state, sentence in item.parts if state is State.BAD][1:]
        yield from (Finding(check_title(item.check), State.BAD, sentence) for sentence in further)
        if item.check is Check.LINK and heard.robot is not None:
            yield _link(heard, round_trip_s)
    if heard.robot is not None:
        yield _mode(heard.robot.status)
        yield _control(heard.robot.status, heard.is_abandoned)
        yield _software(heard.robot)


def _link(heard: Heard, round_trip_s: float) -> Finding:
    is_slow = heard.longest_gap_s > _LONG_GAP_S or round_trip_s > _LONG_GAP_S
    trip = "" if math.isnan(round_trip_s) else f"A round trip takes {_MS_PER_S * round_trip_s:.1f} ms. "
    advice = (f" The robot stops after {MAX_BLIND_S:g} s of silence: bring laptop and robot nearer, or choose another "
              "channel of the Wi-Fi.") if is_slow else ""
    return Finding("Round trip", State.NOTE if is_slow else State.GOOD,
                f"{trip}{heard.count} messages came, {heard.lost} were lost, the longest gap was "
                f"{heard.longest_gap_s:.2f} s.{advice}")


def _mode(status: RobotStatus) -> Finding:
    return Finding("State", State.GOOD, f"The robot says: {status.mode.name.lower().replace('_', ' ')}.")


def _control(status: RobotStatus, is_abandoned: bool) -> Finding:
    """Return the controller of the robot; the checklist states if it prevents a test."""
    if not status.controlled_by_other:
        return Finding("Control", State.GOOD, "No application controls the robot.")
    who = f"an application with the key of {status.controller_name}" if status.controller_name else "an application"
    if is_abandoned:
        return Finding("Control", State.NOTE, f"The robot waits for {who} that fell silent; the next one takes over.")
    return Finding("Control", State.NOTE, f"The robot obeys {who}.")


def _software(robot: RobotSnapshot) -> Finding:
    """Return a finding on the software. The link's contract has no version: older robots lack fields that were added
    later."""
    status = robot.status
    untold = [what for what, is_untold in (
        ("its steady clock", math.isnan(status.steady_s)), ("its preflight", robot.preflight is None),
        ("its emergency stop", status.emergency_stop is EmergencyStop.UNKNOWN)) if is_untold]
    versions = f"The robot runs {status.software_version or 'an unnamed version'}, this application is {__version__}"
    if untold:
        return Finding("Software", State.NOTE, f"{versions}; the robot does not tell {', '.join(untold)}: upgrade it.")
    return Finding("Software", State.GOOD, f"{versions}; the robot tells all that this application asks of the link.")
