"""All tasks of the benchmark, each a campaign with its own seed, and their results."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import multiprocessing
from typing import Any, Dict, List, NamedTuple, Tuple

from .cars import FADING_SHARE, LAPSE, Polling, Radio
from .nulls import FREQUENCIES_MHZ, NullDraw, over_ground
from .nulls import RADIALS as NULL_RADIALS
from .pass_methods import AXES, AxesDraw, passes, single
from .pass_verdicts import AxesLimitDraw, axes_at_the_limit
from .press_methods import RADIALS, Draw, adaptive, scan
from .referees import neyer, up_and_down
from .repeated import CAMPAIGNS, SPEEDS_MPS
from .verdicts import LimitDraw, at_the_limit

WIDTHS_M = (0.1, 0.4, 1.0, 2.2, 4.0, 6.6)
FADINGS = {"steady": (0.0, 0.0), "fading": (FADING_SHARE, LAPSE)}
# One in this number of campaigns includes the slow methods. The search for the scan's whole time needs three times as
# many presses, and Neyer's design takes as long as ten of our campaigns.
LONG_EVERY = 14
NEYER_RADIALS = 4
# The requirement names a poll of 300 ms and a cycle of 200 ms.
POLLINGS = {"poll_300_cycle_200": Polling(), "poll_100_cycle_20": Polling(0.1, 0.02),
            "poll_700_cycle_200": Polling(0.7, 0.2, 1, 0.1, 0.02),
            "poll_450_cycle_100": Polling(0.45, 0.1, 2, 0.05, 0.02)}


class Amount(NamedTuple):
    """Size of the benchmark: lines of each kind, and number of processes. limit_lines: lines of each kind of whole
    tests."""

    radials: int
    axes: int
    seed: int
    jobs: int
    limit_lines: int = 48


class Task(NamedTuple):
    """One campaign: key of its kind, draw, and whether the referees and the long search are included."""

    key: Tuple[str, ...]
    draw: Any
    is_long: bool = False


# Numbers of lines of whole tests at the limit, and width of the transition of their Cars.
CAMPAIGN_LINES = (4, 8, 16)
LIMIT_WIDTH_M = 1.0
# Methods whose lines are not LineFound, and one whose radials have several boundaries.
AT_LIMIT, OVER_GROUND = "at_limit", "over_ground"
Found = Dict[Tuple[str, ...], List[List[Any]]]


def measure(amount: Amount) -> Found:
    """Return the campaigns, in order, by method and kind of Car."""
    found: Found = {}
    with multiprocessing.Pool(amount.jobs) as pool:
        for results in pool.imap(run_task, tasks(amount), chunksize=1):
            for key, lines in results.items():
                found.setdefault(key, []).append(lines)
    return found


def tasks(amount: Amount) -> List[Task]:
    """Return all campaigns; their seeds differ by kind."""
    made = []
    for (place, (kind, (share, lapse))), (row, width_m) in itertools.product(enumerate(FADINGS.items()),
                                                                             enumerate(WIDTHS_M)):
        for number in range(-(-amount.radials // RADIALS)):
            seed = seed_of(amount.seed, row, place, number)
            made.append(Task((kind, f"{width_m:g}"), Draw(Radio(width_m, share, lapse), seed, seed),
                             number % LONG_EVERY == 0))
    for kind, polling in POLLINGS.items():
        for number in range(-(-amount.axes // AXES)):
            seed = seed_of(amount.seed, 50, len(made), number)
            made.append(Task((kind,), AxesDraw(polling, seed, seed)))
    for number in range(CAMPAIGNS):
        noise = seed_of(amount.seed, 70, 0, number)
        made.append(Task(("again_key_press",), Draw(Radio(1.0, 0.0, 0.0), amount.seed, noise)))
        made.append(Task(("again_autolock",), AxesDraw(Polling(), amount.seed, noise, SPEEDS_MPS[number % 5])))
    return [*made, *_limit_tasks(amount), *_null_tasks(amount)]


def _limit_tasks(amount: Amount) -> List[Task]:
    """Return the tasks of whole tests of Cars at their limits."""
    made = []
    for row, lines in enumerate(CAMPAIGN_LINES):
        for place, (kind, (share, lapse)) in enumerate(FADINGS.items()):
            for column, search in enumerate(("key_press", "handle_request")):
                made += [Task((search, kind, f"{lines}"), LimitDraw(
                    search, Radio(LIMIT_WIDTH_M, share, lapse), lines,
                    seed_of(amount.seed, 80 + column, 10 * row + place, number)))
                    for number in range(-(-amount.limit_lines // lines))]
        made += [Task(("autolock", "poll_300_cycle_200", f"{lines}"), AxesLimitDraw(
            Polling(), lines, seed_of(amount.seed, 82, row, number)))
            for number in range(-(-amount.limit_lines // lines))]
    return made


def _null_tasks(amount: Amount) -> List[Task]:
    """Return the tasks of Key press over reflecting ground."""
    return [Task((f"{mhz:.0f}_mhz",), NullDraw(mhz, seed_of(amount.seed, 90, row, number)))
            for row, mhz in enumerate(FREQUENCIES_MHZ) for number in range(-(-amount.radials // NULL_RADIALS))]


def seed_of(*parts: int) -> int:
    """Combine several small numbers into one seed."""
    seed = 0
    for part in parts:
        seed = 1000 * seed + part
    return seed


def run_task(task: Task) -> Dict[Tuple[str, ...], List[Any]]:
    """Run all methods on one campaign."""
    if isinstance(task.draw, LimitDraw):
        return {(AT_LIMIT, *task.key): at_the_limit(task.draw)}
    if isinstance(task.draw, AxesLimitDraw):
        return {(AT_LIMIT, *task.key): axes_at_the_limit(task.draw)}
    if isinstance(task.draw, NullDraw):
        return {(OVER_GROUND, *task.key): over_ground(task.draw)}
    if isinstance(task.draw, AxesDraw):
        found = {("passes", *task.key): passes(task.draw)}
        return found if task.key[0].startswith("again") else {**found, ("single", *task.key): single(task.draw)}
    found = {("adaptive", *task.key): adaptive(task.draw)}
    if task.key[0].startswith("again"):
        return found
    scanned = scan(task.draw)
    found.update({("scan", *task.key): scanned, ("up_and_down", *task.key): up_and_down(task.draw)})
    if task.is_long:
        found[("adaptive_scan_time", *task.key)] = adaptive(task.draw, [line.time_s for line in scanned])
        found[("scan_beside", *task.key)] = scanned
        designed = neyer(task.draw, NEYER_RADIALS)
        if designed:
            found[("neyer", *task.key)] = designed
    return found
