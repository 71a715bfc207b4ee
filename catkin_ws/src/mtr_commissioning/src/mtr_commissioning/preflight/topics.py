"""Checks that every topic has one publisher, a sufficient rate and fresh messages."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics
from typing import Iterator, List

from mtr_core import names
from mtr_core.schedule import CLOCK_STEP
from mtr_motion_check.finding import Finding, bad, good

from .expected import Expected, Setup, expected_topics
from .records import RobotRecord, ScanContent, TopicRecord

# Tolerance for stamps ahead of the robot's clock: rounding and a network clock's jitter. A simulator's messages may
# overtake its clock by a step.
MAX_AHEAD_S = 0.005
MAX_AHEAD_SIMULATED_S = CLOCK_STEP.period_ns * 1e-9 + MAX_AHEAD_S
# Beams without a number, or with zero, are not measurements (REP 117); a few are usual with some drivers.
MAX_NOT_NUMBERS = 0.1
# Drive control stops for a wider sector without a measurement in one scan: its kLegRad.
MAX_UNSEEN_RAD = 0.175
# A sweep ends before the next one begins; drivers round both.
MAX_SWEEP_PERIODS = 1.05
PRESENCE, PUBLISHERS, RATE, GAP, AGE, CONTENT, BEAM_TIME = (
    "topic.present", "topic.publishers", "topic.rate", "topic.gap", "topic.age", "scan.content", "scan.beam_time")
MIN_MESSAGES = 2


def topic_findings(record: RobotRecord, setup: Setup) -> List[Finding]:
    """Check all expected topics, and the wheel command."""
    found = [command_finding(record.topic(names.WHEEL_COMMAND))]
    for expected in expected_topics(setup):
        heard = record.topic(expected.topic)
        problems = [*presence_problems(expected, heard, record.listened_s)]
        problems = problems or [*timing_problems(expected, heard, setup), *scan_problems(expected.topic, heard.scans),
                                *beam_time_problems(expected.topic, heard, setup)]
        found += problems or [good(RATE, expected.topic, summary(heard), rate_hz(heard), expected.min_rate_hz,
        unit="Hz")]
    return found


def command_finding(heard: TopicRecord) -> Finding:
    """Check that one node commands the wheels."""
    topic, count = names.WHEEL_COMMAND, len(heard.publishers)
    if count == 1:
        return good(PUBLISHERS, topic, f"{heard.publishers[0]} alone commands the wheels.", count, 1)
    if count == 0:
        return bad(PUBLISHERS, topic, "No node commands the wheels, allowed is 1: start drive control (robot.launch).",
                   0, 1)
    return bad(PUBLISHERS, topic, f"{count} nodes command the wheels ({', '.join(heard.publishers)}), allowed is 1: "
               "end all but drive control, twist_mux and teleop above all.", count, 1)


def presence_problems(expected: Expected, heard: TopicRecord, listened_s: float) -> Iterator[Finding]:
    """Report missing messages and wrong types."""
    topic, count = expected.topic, len(heard.publishers)
    if not count:
        yield bad(PRESENCE, topic, f"No node publishes it, 1 is needed: {expected.remedy}.", 0, 1)
    elif heard.type and heard.type != expected.type:
        yield bad(PRESENCE, topic, f"Its type is {heard.type}, allowed is {expected.type}: end the node "
                  f"{heard.publishers[0]}, or let it publish elsewhere.")
    elif count > 1:
        yield bad(PUBLISHERS, topic, f"{count} nodes publish it ({', '.join(heard.publishers)}), allowed is 1: end all "
                  "but one, or let them publish elsewhere.", count, 1)
    elif len(heard.arrivals_s) < MIN_MESSAGES:
        came = len(heard.arrivals_s)
        yield bad(PRESENCE, topic, f"{heard.publishers[0]} publishes it, but {came} messages came in {listened_s:.1f} "
                  f"s, at least {MIN_MESSAGES} are needed: {expected.remedy}, and look at its log.", came, MIN_MESSAGES)


def silent_topics(record: RobotRecord, setup: Setup) -> List[str]:
    """Return topics with a publisher but too few messages so far for a check."""
    heard = {expected.topic: record.topic(expected.topic) for expected in expected_topics(setup)}
    return [topic for topic, each in heard.items() if each.publishers and len(each.arrivals_s) < MIN_MESSAGES]


def rate_hz(heard: TopicRecord) -> float:
    """Return the mean rate between the first and the last message."""
    span_s = heard.arrivals_s[-1] - heard.arrivals_s[0]
    return (len(heard.arrivals_s) - 1) / span_s if span_s > 0.0 else 0.0


def longest_gap_s(heard: TopicRecord) -> float:
    """Return the longest time between two consecutive messages."""
    return max(after - before for before, after in zip(heard.arrivals_s, heard.arrivals_s[1:]))


def newest_age_s(heard: TopicRecord) -> float:
    """Return the maximum age of the newest message before the next one arrived; 0 without stamps."""
    return max((age_s + after - before
                for age_s, before, after in zip(heard.ages_s, heard.arrivals_s, heard.arrivals_s[1:])), default=0.0)


def timing_problems(expected: Expected, heard: TopicRecord, setup: Setup) -> Iterator[Finding]:
    """Report a low rate, a long gap, old messages, or messages from the future."""
    topic, rate, gap_s = expected.topic, rate_hz(heard), longest_gap_s(heard)
    if rate < expected.min_rate_hz:
        yield bad(RATE, topic, f"It comes at {rate:.1f} Hz, at least {expected.min_rate_hz:.1f} Hz are needed: raise "
                  "the rate in its driver, or look what loads network and processor.", rate, expected.min_rate_hz,
                  unit="Hz")
    elif gap_s > expected.max_gap_s:
        yield bad(GAP, topic, f"It was silent for {gap_s:.2f} s, allowed is {expected.max_gap_s:.2f} s: look at the "
                  "cable and at what loads network and processor.", gap_s, expected.max_gap_s, unit="s")
    elif expected.max_newest_age_s and newest_age_s(heard) > expected.max_newest_age_s:
        yield bad(GAP, topic, f"Its newest sweep was {newest_age_s(heard):.2f} s old before the next one came, allowed "
                  f"is {expected.max_newest_age_s:.2f} s, at which drive control brakes: raise the rate in its driver, "
                  "or look at the cable and at what loads network and processor.", newest_age_s(heard),
                  expected.max_newest_age_s, unit="s")
    if expected.max_age_s and heard.ages_s:
        yield from age_problems(expected, heard.ages_s, MAX_AHEAD_SIMULATED_S if setup.is_simulated else MAX_AHEAD_S)


def age_problems(expected: Expected, ages_s: List[float], max_ahead_s: float) -> Iterator[Finding]:
    """Report stamps from the future, or too far in the past."""
    topic, median_s, worst_s, first_s = expected.topic, statistics.median(ages_s), max(ages_s), min(ages_s)
    if first_s < -max_ahead_s:
        yield bad(AGE, topic, f"Its stamps are up to {-first_s:.3f} s ahead of this computer's clock, allowed is "
                  f"{max_ahead_s:.3f} s: synchronise the clock of the computer or sensor that stamps it (chrony).",
                  first_s, -max_ahead_s, unit="s")
    elif median_s > 0.5 * expected.max_age_s:
        yield bad(AGE, topic, f"It is {median_s:.3f} s old when it arrives (median), allowed is "
                  f"{0.5 * expected.max_age_s:.3f} s: synchronise the clock that stamps it (chrony), or look what "
                  "delays it.", median_s, 0.5 * expected.max_age_s, unit="s")
    elif worst_s > expected.max_age_s:
        yield bad(AGE, topic, f"It was up to {worst_s:.3f} s old when it arrived, allowed is {expected.max_age_s:.3f} "
                  "s: look what loads network and processor.", worst_s, expected.max_age_s, unit="s")


def scan_problems(topic: str, scans: List[ScanContent]) -> Iterator[Finding]:
    """Report scans without content."""
    if not scans:
        return
    empty = sum(scan.hits == 0 for scan in scans)
    if 2 * empty > len(scans):
        yield bad(CONTENT, topic, f"{empty} of {len(scans)} scans see nothing at all, allowed is half: uncover the "
                  "LiDAR, or bring the robot to where something stands within its range.", empty, len(scans) // 2)
        return
    share = statistics.median(scan.not_numbers / scan.beams for scan in scans if scan.beams)
    if share > MAX_NOT_NUMBERS:
        yield bad(CONTENT, topic, f"{100.0 * share:.0f} % of its beams are zero or not a number, allowed is "
                  f"{100.0 * MAX_NOT_NUMBERS:.0f} %: uncover and clean the LiDAR, look at filters, or bring the "
                  "robot to where something stands within its range.", share, MAX_NOT_NUMBERS)
        return
    wide = [scan.unseen_rad for scan in scans if scan.unseen_rad > MAX_UNSEEN_RAD]
    if len(wide) > MAX_NOT_NUMBERS * len(scans):
        yield bad(CONTENT, topic, f"Up to {math.degrees(max(wide)):.0f} deg of it in one piece are zero or not a "
                  f"number, allowed is {math.degrees(MAX_UNSEEN_RAD):.0f} deg, beyond which drive control stands: "
                  "uncover and clean the LiDAR, or bring the robot to where something stands within its range.",
                  max(wide), MAX_UNSEEN_RAD, unit="rad")


def beam_time_problems(topic: str, heard: TopicRecord, setup: Setup) -> Iterator[Finding]:
    """Report beams whose stated times are all equal, or exceed the time of a turn.

    In the first case a robot that turns at 0.5 rad/s sees its surroundings sheared by 1 degree with a LiDAR of 25 Hz,
    without any other symptom. Some simulators do measure all beams at once.
    """
    rate = rate_hz(heard)
    # Without a rate, as with a stopped clock, a sweep has no reference.
    if not heard.scans or not rate:
        return
    sweep_s, period_s = statistics.median(scan.sweep_s for scan in heard.scans), 1.0 / rate
    if sweep_s == 0.0 and not setup.is_simulated and not setup.time_increment_s:
        yield bad(BEAM_TIME, topic, "Its scans do not say when each beam was measured (time_increment is 0), so that "
                  "they are wrong while the robot moves: name the LiDAR (lidar of robot.launch), or have its driver "
                  "say it.", 0.0, unit="s")
    elif not 0.0 <= sweep_s <= MAX_SWEEP_PERIODS * period_s:
        yield bad(BEAM_TIME, topic, f"From its first to its last beam a scan takes {sweep_s:.3f} s (time_increment), "
                  f"allowed is the {period_s:.3f} s from scan to scan: look at the driver's settings.", sweep_s,
                  period_s, unit="s")


def summary(heard: TopicRecord) -> str:
    """Return rate, gap and age of a topic without faults."""
    text = f"{rate_hz(heard):.1f} Hz, longest gap {longest_gap_s(heard):.3f} s"
    if heard.ages_s:
        text += f", age {statistics.median(heard.ages_s):.3f} s (median), {max(heard.ages_s):.3f} s (worst)"
    return f"{text}."
