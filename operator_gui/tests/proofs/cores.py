"""The kernel cores: how fast it is on one core, and whether it measures what whole stacks measure."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import pathlib
import statistics
import tempfile
import time

import demo_again

from mtr_campaign.kernels.order import order_of
from mtr_campaign.kernels.registry import kernel_of
from mtr_campaign.kernels.stack import DEMO_FOLDER
from mtr_campaign.plan.run import Run
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import FILE_NAME, open_progress

# Issue 20: 15 times as fast as real time on one core, distances equal to 1 mm.
MIN_FACTOR, SAME_M = 15.0, 0.001
MS_PER_S, MM_PER_M = 1e3, 1e3
SHORT = {"car": "honest", "parameters.passes": 1, "parameters.measuring_speed_mps": 0.3,
         "parameters.measurements_distance_m": 10.0}
SHORT_PRESS = {"car": "honest_button", "parameters.minimum_distance_m": 3.0, "parameters.maximum_distance_m": 7.0,
               "parameters.interval_m": 0.5, "parameters.attempts_limit": 6,
               "parameters.angle_between_radials_deg": 45.0}


def speed(seeds, first_seed):
    """Rows: processor time for a second of the robot, by the median of some tests after one that loads all modules."""
    rows = []
    for name, scenario, settings in (("autolock, 8 axes, one pass", "autolock", SHORT),
                                     ("key press, 8 radials", "key_press", SHORT_PRESS)):
        each_ms = [ms_per_s(scenario, {**settings, "seed": seed}) for seed in range(first_seed, first_seed + seeds + 1)]
        median_ms = statistics.median(each_ms[1:])
        rows += [(f"cores: {name}", "ms/s", round(median_ms, 1), round(MS_PER_S / MIN_FACTOR, 1)),
                 (f"cores: {name}", "x real time", round(MS_PER_S / median_ms, 1), None)]
    return rows


def ms_per_s(scenario, settings):
    """Processor time of this process for each second of the robot."""
    with tempfile.TemporaryDirectory() as folder:
        began_s = time.process_time()
        found = ran("cores", scenario, settings, pathlib.Path(folder))
        return MS_PER_S * (time.process_time() - began_s) / found.figures["robot_s"]


def ran(kernel, scenario, settings, folder):
    """Outcome of one test."""
    run = Run(kernel, scenario, settings)
    return kernel_of(kernel).run(order_of(run), folder, run.digest)


def equality(seed, is_short):
    """Rows, and counts that must be zero: distances of the two kernels under the same seed."""
    wanted = [("autolock, 8 axes", "autolock", SHORT), ("key press, 8 radials", "key_press", SHORT_PRESS)]
    if not is_short:
        wanted = [("autolock of the demo, 16 axes", "autolock", demo_again.AUTOLOCK),
                  ("key press of the demo, 8 radials", "key_press", {**demo_again.KEY_PRESS, "car": "honest_button"})]
    rows, off = [], 0
    for name, scenario, settings in wanted:
        ours, stacks = (measured(kernel, scenario, {**settings, "seed": seed}) for kernel in ("cores", "stack"))
        apart_m = [apart(ours.get(key), stacks.get(key)) for key in {*ours, *stacks}]
        off += sum(1 for each in apart_m if each > SAME_M)
        rows.append((f"cores and stack: {name}, {len(apart_m)} distances", "mm", round(MM_PER_M * max(apart_m), 3),
                     MM_PER_M * SAME_M))
    return rows, {"cores: distances that are not the stack's to 1 mm": off}


def measured(kernel, scenario, settings):
    """What is in metres of each line, by line and name of the field."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        ran(kernel, scenario, settings, folder)
        kept = folder / DEMO_FOLDER / scenario if kernel == "stack" else folder
        results = open_progress(kept / FILE_NAME, SCENARIOS)[2].results
    return {(result.number, field.name): getattr(result, field.name) for result in results
            for field in dataclasses.fields(result) if field.name.endswith("_m")
            and isinstance(getattr(result, field.name), (float, type(None)))}


def apart(one_m, other_m):
    """By how much two distances differ in m; where only one of them is known by more than any may."""
    if one_m is None or other_m is None:
        return 0.0 if one_m is other_m else 1.0
    return abs(one_m - other_m)
