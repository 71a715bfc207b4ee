"""The simulated robot on the machine's clock: stamps of the instants at which sensors measured."""
# SPDX-License-Identifier: Apache-2.0
import os

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.liveness import Instant
from mtr_core.schedule import LIDAR
from mtr_simulation.clock.machine import (
    MAX_STOOD_NS,
    NICENESS,
    StampOffset,
    stamped,
    stood_offsets,
    take_precedence,
)
from mtr_simulation.sim import Sim
from mtr_simulation.site.scenario import named_scenario


class Clocks:
    """A settable machine clock and a steady clock."""

    def __init__(self):
        self.clock_ns, self.steady_ns, self.due_s = 5_000_000_000, 2_000_000_000, 2.0

    def read(self) -> Instant:
        """Both clocks."""
        return Instant(self.clock_ns, self.steady_ns)

    def pass_by(self, duration_ns: int) -> None:
        """Advance both clocks."""
        self.clock_ns += duration_ns
        self.steady_ns += duration_ns

    def offset(self) -> StampOffset:
        """Offset of stamps for these clocks."""
        return StampOffset(False, 1.0, lambda: self.due_s, self.read)


def test_in_simulation_stamps_are_the_simulated_clocks():
    assert StampOffset(True, 0.0, lambda: 7.0, Clocks().read).at(1_020_000_000) == 0


def test_on_the_machines_clock_stamps_follow_it_where_it_is_set():
    clocks = Clocks()
    offset = clocks.offset()
    assert 1_000_000_000 + offset.at(1_000_000_000) == 5_000_000_000
    clocks.clock_ns -= 3_600_000_000_000
    assert 1_000_000_000 + offset.at(1_000_000_000) == clocks.clock_ns


def test_a_tick_that_comes_late_is_stamped_when_it_was_due():
    clocks = Clocks()
    offset = clocks.offset()
    stamps = [1_000_000_000 + offset.at(1_000_000_000)]
    clocks.pass_by(80_000_000)
    clocks.due_s += 0.02
    # The two clocks are not read at exactly the same instant.
    clocks.clock_ns += 300_000
    stamps.append(1_020_000_000 + offset.at(1_020_000_000))
    assert stamps == [5_000_000_000, 5_020_000_000]


def test_machines_clock_cannot_run_faster():
    with pytest.raises(ConfigurationError, match="real_time_factor is 4"):
        StampOffset(False, 4.0, lambda: 0.0, Clocks().read)


def test_the_simulator_runs_before_other_programs_where_the_system_permits_it(monkeypatch):
    wanted = []
    monkeypatch.setattr("os.setpriority", lambda *values: wanted.append(values))
    assert take_precedence()
    assert wanted == [(os.PRIO_PROCESS, 0, NICENESS)]

    def refuse(*_: int) -> None:
        raise PermissionError

    monkeypatch.setattr("os.setpriority", refuse)
    assert not take_precedence()


@pytest.mark.parametrize("leader, written", [(0, "-10"), (1, "")], ids=["own session", "another's session"])
def test_the_simulator_s_own_session_comes_before_others(leader, written, monkeypatch, tmp_path):
    group = tmp_path / "autogroup"
    group.touch()
    monkeypatch.setattr("mtr_simulation.clock.machine.AUTOGROUP", group)
    monkeypatch.setattr("os.setpriority", lambda *values: None)
    monkeypatch.setattr("os.getsid", lambda of: os.getpid() + leader)
    assert take_precedence()
    assert group.read_text(encoding="ascii") == written
    monkeypatch.setattr("mtr_simulation.clock.machine.AUTOGROUP", tmp_path / "of no such kernel")
    assert take_precedence()


@pytest.mark.parametrize("lost_ns", [1_000_000, 20_000_000, 30_000_000, 310_000_000])
def test_gyro_and_wheels_tell_of_no_turn_for_which_the_world_stood_still(lost_ns):
    sim, offset_ns, read = Sim(1, named_scenario("open")), 7_000, []
    start_rad = sim.truth().world_from_base.heading
    for tick in range(150):
        sim.command(0.3, 0.8)
        sensors = sim.step()
        lost_now_ns = lost_ns if tick in (60, 101) else 0
        read.append(stamped(sensors, offset_ns))
        offset_ns += lost_now_ns
        stood = [stamped(sim.stand(), stood_ns) for stood_ns in stood_offsets(offset_ns, lost_now_ns)]
        assert {each.odometry for each in stood} <= {sensors.odometry._replace(linear_mps=0.0, angular_radps=0.0)}
        read += stood
    stamps = [each.time_ns for each in read]
    assert stamps[-1] - stamps[0] == 149 * 20_000_000 + 2 * lost_ns
    assert all(0 < after - before <= 20_000_000 for before, after in zip(stamps, stamps[1:]))
    # Same integration as in localization: a reading is the mean since the previous reading.
    turned_rad = sum(after.imu.angular_velocity[2] * (after.time_ns - before.time_ns) * 1e-9
                     for before, after in zip(read, read[1:]))
    assert turned_rad == pytest.approx(sim.truth().world_from_base.heading - start_rad, abs=0.01)


def test_sweep_during_which_the_world_stood_still_is_lost_and_the_next_one_is_whole():
    sim = Sim(1, named_scenario("open"))
    swept = []
    for tick in range(12):
        swept.append(sim.step().front_scan is not None)
        if tick == 4:
            assert sim.stand().front_scan is None
    assert swept == [False, True, False, True, False, False, *[False, True] * 3]


def test_after_a_long_absence_sensors_were_silent():
    assert stood_offsets(0, MAX_STOOD_NS + 1) == [] == stood_offsets(0, 0)


def test_scans_keep_their_age_when_all_stamps_are_moved():
    sim = Sim(1, named_scenario("open"))
    readings = [sim.step() for _ in range(4)]
    moved = [stamped(each, 7_000) for each in readings]
    assert [each.time_ns for each in moved] == [each.time_ns + 7_000 for each in readings]
    scans = [(each.time_ns, each.front_scan) for each in moved if each.front_scan]
    assert scans and all(time_ns - scan.stamp_ns == LIDAR.period_ns for time_ns, scan in scans)
