"""Campaigns: how many tests a minute, how well workers share them, and what a killed worker costs.

Usage: campaigns.py [--runs N] [--pairs N] [--cores N] [--stacks N] [--seed N] [--short] [--out FOLDER]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import contextlib
import dataclasses
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import time

import cores
import demo_again
import table
from sqlalchemy import func, select

from mtr_campaign.plan.factors import Values
from mtr_campaign.plan.plan import Design, Plan
from mtr_campaign.work.conductor import Conductor, Course
from mtr_campaign.work.crew import Here, crew_of
from mtr_campaign.work.folder import CampaignFolder
from mtr_campaign.work.keeping import Keeping
from mtr_results.model.tests import Test
from mtr_results.store.database import Database, engine_of

WORKERS = (1, 2, 4)
SECONDS_A_MINUTE, SECONDS_AN_HOUR = 60.0, 3600.0
# A worker dies when so much of its campaign is done.
KILLED_AFTER = 0.3
# One pass on each of 12 axes, without the estimation of static boundaries.
ONE_PASS = {"car": "honest", "parameters.passes": 1, "parameters.measuring_speed_mps": 0.4,
            "parameters.measurements_distance_m": 2.0}


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=200, help="of one pass for each number of workers (%(default)s)")
    parser.add_argument("--pairs", type=int, default=100, help="of the demo with itself, 0 for none (%(default)s)")
    parser.add_argument("--cores", type=int, default=3, help="tests of each kind on the cores (%(default)s)")
    parser.add_argument("--stacks", type=int, default=0, help="whole stacks, alone and with two workers (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--short", action="store_true", help="no share must be met")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    options = parser.parse_args()
    counts, rows = {}, []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        rows += rates(folder, options)
        rows += efficiencies(folder, options)
        counts.update(killed(folder, options))
        if options.cores:
            rows += cores.speed(options.cores, options.seed)
            rows += on_cores(folder, options)
        if options.stacks:
            rows += stacks(folder, options)
            found_rows, off = cores.equality(options.seed, options.short)
            rows += found_rows
            counts.update(off)
    figures = {"runs": options.runs, "pairs": options.pairs, "processors": os.cpu_count()}
    if options.pairs:
        found = demo_again.measure(options.pairs, options.seed, options.out / "campaign")
        rows += demo_again.rows(found)
        figures["demo_again"] = found
        if not options.short:
            counts.update(demo_again.missing(found))
    return table.finish(options.out / "campaign.json", figures, counts, rows)


def plan(name, runs, first_seed, scenario="autolock", fixed=None):
    """Repetitions that differ in their noise alone."""
    seeds = Values(tuple(range(first_seed, first_seed + runs)))
    return Plan(name, "radio", scenario, ONE_PASS if fixed is None else fixed, {"seed": seeds}, Design())


def run(wanted, folder, crew, told=lambda done, was_done: None):
    """Wall time in s, and the course."""
    place = CampaignFolder(folder / wanted.name)
    place.make()
    course = Course(told)
    began_s = time.monotonic()
    Conductor(wanted, place, crew).run(course)
    assert not course.failed, course.failed[0].reason
    return time.monotonic() - began_s, course


def rates(folder, options):
    """Tests a minute in one process, which has made its tables before."""
    found = []
    wanted = [("autolock, 12 axes, one pass", "autolock", ONE_PASS, max(options.runs // 5, 2))]
    if not options.short:
        wanted += [("autolock of the demo, 16 axes, two passes", "autolock", demo_again.AUTOLOCK, 6),
                   ("key press of the demo, 8 radials", "key_press", demo_again.KEY_PRESS, 6)]
    for name, scenario, fixed, runs in wanted:
        run(plan("warm", 1, options.seed, scenario, fixed), folder, Here())
        shutil.rmtree(folder / "warm")
        took_s, _ = run(plan("rate", runs, options.seed + 1, scenario, fixed), folder, Here())
        shutil.rmtree(folder / "rate")
        found.append((f"radio: {name}", "tests/min/core", round(SECONDS_A_MINUTE * runs / took_s, 1), None))
    return found


def efficiencies(folder, options):
    """Of several workers against one, on as many processors as there are."""
    rates_per_s = {}
    for workers in WORKERS:
        with crew_of(workers) as crew:
            # Each worker loads its modules and makes its tables once.
            run(plan(f"warm_{workers}", 2 * workers, options.seed), folder, crew)
            took_s, _ = run(plan(f"shared_{workers}", options.runs, options.seed + 1000), folder, crew)
        rates_per_s[workers] = options.runs / took_s
    found = []
    for workers in WORKERS:
        share = rates_per_s[workers] / (rates_per_s[1] * min(workers, os.cpu_count()))
        found += [(f"radio: {workers} workers", "tests/min", round(SECONDS_A_MINUTE * rates_per_s[workers], 1), None),
                  (f"efficiency of {workers} workers, by processors", "%", round(100.0 * share, 1), None)]
    return found


def killed(folder, options):
    """A worker is killed in the middle of a campaign: what is lost, and what is there twice."""
    runs = max(options.runs // 4, 8)
    wanted = plan("killed", runs, options.seed + 5000)
    keeping = Keeping(str(folder / "killed.sqlite"), CampaignFolder(folder / wanted.name), wanted.name)
    times = []
    with crew_of(2) as crew:
        pids = list(crew.client.run(os.getpid).values())

        def told(done, was_done):
            keeping.take(done)
            times.append(done.digest)
            if len(times) == round(KILLED_AFTER * runs):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pids[0], signal.SIGKILL)

        _, course = run(wanted, folder, crew, told)
    place = CampaignFolder(folder / wanted.name)
    kept = [each for each in (place.path / "runs").iterdir() if not each.name.startswith(".")]
    with Database(engine_of(str(folder / "killed.sqlite"))).reading() as connection:
        stored = connection.execute(select(func.count(Test.id))).scalar_one()
    return {"killed worker: runs lost": runs - len(course.runs), "killed worker: runs told twice": len(times) - len(
        set(times)), "killed worker: folders lost or twice": abs(len(kept) - runs),
            "killed worker: tests in the store lost or twice": abs(stored - runs)}


def on_cores(folder, options):
    """Whole robots without ROS an hour, one at a time and two at a time."""
    found, runs = [], max(2 * options.cores, 4)
    for workers in (1, 2):
        wanted = plan(f"cores_{workers}", runs, options.seed)
        with crew_of(workers) as crew:
            took_s, _ = run(dataclasses.replace(wanted, kernel="cores"), folder, crew)
        found.append((f"cores: autolock, 12 axes, {workers} at a time", "tests/h",
                      round(SECONDS_AN_HOUR * runs / took_s, 1), None))
    return found


def stacks(folder, options):
    """Whole robots an hour, one at a time and two at a time."""
    found = []
    for workers in (1, 2):
        wanted = plan(f"stacks_{workers}", options.stacks, options.seed)
        with crew_of(workers) as crew:
            took_s, _ = run(dataclasses.replace(wanted, kernel="stack"), folder, crew)
        found.append((f"stack: autolock, 12 axes, {workers} at a time", "tests/h",
                      round(SECONDS_AN_HOUR * options.stacks / took_s, 1), None))
    return found


if __name__ == "__main__":
    sys.exit(main())
