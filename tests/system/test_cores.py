"""The kernel `cores` measures what the whole stack does: the same seed gives the same results, to a millimetre.

`make bench-campaign STACKS=2` compares the tests of the demo, with all their axes and radials.
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest

from mtr_campaign.kernels.order import order_of
from mtr_campaign.kernels.registry import kernel_of
from mtr_campaign.kernels.stack import DEMO_FOLDER
from mtr_campaign.plan.run import Run
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import FILE_NAME, open_progress

SAME_M = 0.001
TESTS = {
    # Eight axes, one from each side and corner.
    "autolock": {"car": "honest", "seed": 3, "parameters.passes": 1, "parameters.measuring_speed_mps": 0.5,
                 "parameters.measurements_distance_m": 10.0},
    # Four radials; on each, presses look for holes on the way besides those that search for its boundary.
    "key_press": {"car": "honest_button", "seed": 3, "parameters.minimum_distance_m": 3.0,
                  "parameters.maximum_distance_m": 7.0, "parameters.interval_m": 0.5, "parameters.attempts_limit": 12,
                  "parameters.angle_between_radials_deg": 90.0}}
# What is measured, by the names of the results' fields.
DISTANCES = {"autolock": ("unlock_distance_m", "lock_distance_m"), "key_press": ("d50_m",)}
MIN_KNOWN = {"autolock": 12, "key_press": 3}


def results(kernel, scenario, folder):
    """Results of all lines as the application has kept them."""
    run = Run(kernel, scenario, TESTS[scenario])
    folder.mkdir()
    kernel_of(kernel).run(order_of(run), folder, run.digest)
    kept = folder / DEMO_FOLDER / scenario if kernel == "stack" else folder
    return open_progress(kept / FILE_NAME, SCENARIOS)[2].results


def metres(result):
    """All that is in metres: distances, their sigmas and limits, places of presses, offsets of the robot."""
    fields = {field.name: getattr(result, field.name) for field in dataclasses.fields(result)}
    return {name: list(value) if isinstance(value, tuple) else value for name, value in fields.items()
            if name.endswith("_m") and not isinstance(value, str)}


@pytest.mark.parametrize("scenario", TESTS)
def test_everything_measured_is_what_the_whole_stack_measures(scenario, tmp_path):
    ours, stacks = (results(kernel, scenario, tmp_path / kernel) for kernel in ("cores", "stack"))
    assert [result.number for result in ours] == [result.number for result in stacks]
    known = [getattr(result, name) for result in stacks for name in DISTANCES[scenario]]
    assert len([value for value in known if value is not None]) >= MIN_KNOWN[scenario]
    for our, stack in zip(ours, stacks):
        assert [each.status for each in our.distances] == [each.status for each in stack.distances], our.number
        assert metres(our) == pytest.approx(metres(stack), abs=SAME_M), our.number
