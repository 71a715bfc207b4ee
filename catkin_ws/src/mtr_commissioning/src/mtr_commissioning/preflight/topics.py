"""Is every topic there, from one node, often enough and fresh?"""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics
from typing import Iterator, List

from mtr_core import names
from mtr_core.schedule import CLOCK_STEP
from mtr_motion_check.finding import Finding, bad, good

from .expected import Expected, Setup, expected_topics
from .records import RobotRecord, ScanContent, TopicRecord

# Stamps ahead of the robot's clock: nothing but rounding and a network clock's jitter. A simulator's messages may
# overtake its clock by a step.
MAX_AHEAD_S = 0.005
MAX_AHEAD_SIMULATED_S = CLOCK_STEP.period_ns * 1e-9 + MAX_AHEAD_S
# Beams that are not a number are no measurement (REP 117), nor are those of zero; a few are usual with some drivers.
MAX_NOT_NUMBERS = 0.1
# Drive control stands for a wider piece without a measurement in one scan: its kLegRad.
MAX_UNSEEN_RAD = 0.175
# A sweep ends before the next one begins; drivers round both.
MAX_SWEEP_PERIODS = 1.05
PRESENCE, PUBLISHERS, RATE, GAP, AGE, CONTENT, BEAM_TIME = (
    "topic.present", "topic.publishers", "topic.rate", "topic.gap", "topic.age", "scan.content", "scan.beam_time")
MIN_MESSAGES = 2


def topic_findings(record: RobotRecord, setup: Setup) -> List[Finding]:
    """Of all expected topics, and of the wheels' command."""
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
    """One node commands the wheels."""
    topic, count = names.WHEEL_COMMAND, len(heard.publishers)
    if count == 1:
        return good(PUBLISHERS, topic, f"{heard.publishers[0]} alone commands the wheels.", count, 1)
    if count == 0:
        return bad(PUBLISHERS, topic, "No node commands the wheels, allowed is 1: start drive control (robot.launch).",
                   0, 1)
    return bad(PUBLISHERS, topic, f"{count} nodes command the wheels ({', '.join(heard.publishers)}), allowed is 1: "
               "end all but drive control, twist_mux and teleop above all.", count, 1)


def presence_problems(expected: Expected, heard: TopicRecord, listened_s: float) -> Iterator[Finding]:
    """Nothing, or the wrong thing, comes."""
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
    """Topics that a node publishes, and of which too few messages came until now to say anything about them."""
    heard = {expected.topic: record.topic(expected.topic) for expected in expected_topics(setup)}
    return [topic for topic, each in heard.items() if each.publishers and len(each.arrivals_s) < MIN_MESSAGES]


def rate_hz(heard: TopicRecord) -> float:
    """Mean rate between the first and the last message."""
    span_s = heard.arrivals_s[-1] - heard.arrivals_s[0]
    return (len(heard.arrivals_s) - 1) / span_s if span_s > 0.0 else 0.0


def longest_gap_s(heard: TopicRecord) -> float:
    """Between two messages that follow each other."""
    return max(after - before for before, after in zip(heard.arrivals_s, heard.arrivals_s[1:]))


def newest_age_s(heard: TopicRecord) -> float:
    """How old the newest message was at most before the next one came; 0 where they have no stamps."""
    return max((age_s + after - before
                for age_s, before, after in zip(heard.ages_s, heard.arrivals_s, heard.arrivals_s[1:])), default=0.0)


def timing_problems(expected: Expected, heard: TopicRecord, setup: Setup) -> Iterator[Finding]:
    """Too seldom, with too long a gap, too old or from the future."""
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
    """Stamps from the future, or too far in the past."""
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
    """Scans without anything in them."""
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
    """Beams that are said to be measured all at once, or one after the other for longer than there is.

    In the first case a robot that turns at 0.5 rad/s sees its surroundings sheared by 1 degree with a LiDAR of 25 Hz,
    and nothing else says so. Some simulators do measure all beams at once.
    """
    rate = rate_hz(heard)
    # Without a rate, as on a clock that stands still, there is nothing to hold a sweep against.
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
    """Rate, gap and age of a topic of which nothing is wrong."""
    text = f"{rate_hz(heard):.1f} Hz, longest gap {longest_gap_s(heard):.3f} s"
    if heard.ages_s:
        text += f", age {statistics.median(heard.ages_s):.3f} s (median), {max(heard.ages_s):.3f} s (worst)"
    return f"{text}."
