"""The simulated robot on the machine's clock: stamps as drivers give them."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.schedule import LIDAR
from mtr_simulation.clock.machine import offset_of, stamped
from mtr_simulation.sim import Sim
from mtr_simulation.site.scenario import named_scenario


def test_in_simulation_stamps_are_the_simulated_clocks():
    assert offset_of(True, 0.0)(1_020_000_000) == 0


def test_on_the_machines_clock_stamps_follow_it_where_it_is_set():
    machine = [5_000_000_000]
    offset = offset_of(False, 1.0, lambda: machine[0])
    assert 1_000_000_000 + offset(1_000_000_000) == 5_000_000_000
    machine[0] -= 3_600_000_000_000
    assert 1_020_000_000 + offset(1_020_000_000) == machine[0]


def test_machines_clock_cannot_run_faster():
    with pytest.raises(ConfigurationError, match="real_time_factor is 4"):
        offset_of(False, 4.0)


def test_scans_keep_their_age_when_all_stamps_are_moved():
    sim = Sim(1, named_scenario("open"))
    readings = [sim.step() for _ in range(4)]
    moved = [stamped(each, 7_000) for each in readings]
    assert [each.time_ns for each in moved] == [each.time_ns + 7_000 for each in readings]
    scans = [(each.time_ns, each.front_scan) for each in moved if each.front_scan]
    assert scans and all(time_ns - scan.stamp_ns == LIDAR.period_ns for time_ns, scan in scans)
