"""The simulated robot on the machine's clock: stamps of the instants at which sensors measured."""
# SPDX-License-Identifier: Apache-2.0
import os

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.liveness import Instant
from mtr_core.schedule import LIDAR
from mtr_simulation.clock.machine import NICENESS, StampOffset, stamped, take_precedence
from mtr_simulation.sim import Sim
from mtr_simulation.site.scenario import named_scenario


class Clocks:
    """The machine's clock, which is set, and the steady one."""

    def __init__(self):
        self.clock_ns, self.steady_ns, self.due_s = 5_000_000_000, 2_000_000_000, 2.0

    def read(self) -> Instant:
        """Both."""
        return Instant(self.clock_ns, self.steady_ns)

    def pass_by(self, duration_ns: int) -> None:
        """Let time go on."""
        self.clock_ns += duration_ns
        self.steady_ns += duration_ns

    def offset(self) -> StampOffset:
        """Of stamps by them."""
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
    # The clocks are not read at the very same instant.
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


def test_scans_keep_their_age_when_all_stamps_are_moved():
    sim = Sim(1, named_scenario("open"))
    readings = [sim.step() for _ in range(4)]
    moved = [stamped(each, 7_000) for each in readings]
    assert [each.time_ns for each in moved] == [each.time_ns + 7_000 for each in readings]
    scans = [(each.time_ns, each.front_scan) for each in moved if each.front_scan]
    assert scans and all(time_ns - scan.stamp_ns == LIDAR.period_ns for time_ns, scan in scans)
