"""The kernel `cores` measures what the whole stack does: the same seed gives the same distances, to a millimetre."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_campaign.kernels.order import order_of
from mtr_campaign.kernels.registry import kernel_of
from mtr_campaign.plan.run import Run

SAME_M = 0.001
TESTS = {
    # Eight axes, one from each side and corner.
    "autolock": {"car": "honest", "seed": 3, "parameters.passes": 1, "parameters.measuring_speed_mps": 0.3,
                 "parameters.measurements_distance_m": 10.0},
    # Eight radials.
    "key_press": {"car": "honest_button", "seed": 3, "parameters.minimum_distance_m": 3.0,
                  "parameters.maximum_distance_m": 7.0, "parameters.interval_m": 0.5, "parameters.attempts_limit": 6,
                  "parameters.angle_between_radials_deg": 45.0}}


def distances(kernel, scenario, folder):
    run = Run(kernel, scenario, TESTS[scenario])
    folder.mkdir()
    outcome = kernel_of(kernel).run(order_of(run), folder, run.digest)
    return {(word, line): value for word, lines in outcome.distances.items() for line, value in lines.items()}


@pytest.mark.parametrize("scenario", TESTS)
def test_distances_are_those_of_the_whole_stack(scenario, tmp_path):
    ours, stacks = (distances(kernel, scenario, tmp_path / kernel) for kernel in ("cores", "stack"))
    assert set(ours) == set(stacks)
    assert len([value for value in stacks.values() if value is not None]) >= 3
    for key, value in stacks.items():
        assert (ours[key] is None) == (value is None), key
        assert value is None or ours[key] == pytest.approx(value, abs=SAME_M), key
