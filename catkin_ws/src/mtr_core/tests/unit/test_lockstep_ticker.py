"""The ticker on the robot's own clock, during clock steps and suspensions of the process. A1, A10"""
# SPDX-License-Identifier: Apache-2.0
import pytest
import rospy

from mtr_core.lockstep import ticker as ticker_module
from mtr_core.lockstep.ticker import NO_CLOCK, NOT_HELD, Ticker
from mtr_core.schedule import MILLISECOND_NS, slot

SECOND_NS = 1000 * MILLISECOND_NS
MAX_SLEEPS = 10


class SetClock:
    """The robot's clock: a wait advances it by its duration and by a given disturbance."""

    def __init__(self, happens_ns=()):
        self.time_ns = 1000 * SECOND_NS
        self.waited_ns = []
        self._happens_ns = list(happens_ns)

    def is_simulated(self):
        return False

    is_held = is_simulated

    def now_ns(self):
        return self.time_ns

    def wait_until(self, time_ns, _meanwhile):
        assert len(self.waited_ns) < MAX_SLEEPS
        self.waited_ns.append(time_ns - self.time_ns)
        self.time_ns = time_ns + (self._happens_ns.pop(0) if self._happens_ns else 0)


@pytest.fixture
def clock(monkeypatch):
    def use(*happens_ns):
        set_clock = SetClock(happens_ns)
        monkeypatch.setattr(ticker_module, "clock", set_clock)
        return set_clock
    return use


def test_ticks_follow_each_other(clock):
    clock()
    ticker = Ticker(slot(100))
    assert [ticker.sleep() - 1000 * SECOND_NS for _ in range(3)] == [100 * MILLISECOND_NS * n for n in (1, 2, 3)]


@pytest.mark.parametrize("stopped_s", [0.1, 0.3, 2.0, 3600.0])
def test_after_a_stop_no_tick_of_before_is_worked_off(clock, stopped_s):
    now = clock(round(stopped_s * SECOND_NS))
    tick_ns = Ticker(slot(100)).sleep()
    assert 0 <= now.time_ns - tick_ns < 100 * MILLISECOND_NS
    assert tick_ns >= (1000 + stopped_s) * SECOND_NS


@pytest.mark.parametrize("step_s", [-0.05, -0.4, -10.0, -3600.0])
def test_after_a_step_back_nobody_waits_for_the_time_of_before(clock, step_s):
    now = clock(round(step_s * SECOND_NS))
    ticker = Ticker(slot(100))
    for _ in range(3):
        tick_ns = ticker.sleep()
        assert abs(now.time_ns - tick_ns) < 100 * MILLISECOND_NS
    assert max(now.waited_ns) <= 100 * MILLISECOND_NS


class SimulatedClock(SetClock):
    """Clock of another simulator; each wait for a tick lasts one hour of wall time."""

    def __init__(self, begins_ns, held):
        super().__init__()
        self.time_ns = begins_ns
        self.is_held = lambda: held
        self.wall_s = 0.0

    def is_simulated(self):
        return True

    def stamp_of(self, time_ns):
        return rospy.Time(0, time_ns % SECOND_NS)

    def wait_until(self, time_ns, meanwhile):
        self.wall_s += 3600.0
        meanwhile()
        super().wait_until(time_ns, meanwhile)


class Holds:
    """A topic with a given number of subscribers."""

    def __init__(self, listeners):
        self.get_num_connections = lambda: listeners
        self.publish = lambda message: None


@pytest.mark.parametrize("begins_ns, held, listeners, told", [
    (0, False, 0, [NO_CLOCK]), (0, True, 1, [NO_CLOCK]), (SECOND_NS, True, 0, [NOT_HELD]), (SECOND_NS, True, 1, []),
    (SECOND_NS, False, 0, [])])
def test_simulated_time_that_cannot_go_on_is_told_once(monkeypatch, begins_ns, held, listeners, told):
    simulated = SimulatedClock(begins_ns, held)
    monkeypatch.setattr(ticker_module, "clock", simulated)
    monkeypatch.setattr(ticker_module, "direct_publisher", lambda *arguments, **options: Holds(listeners))
    monkeypatch.setattr(ticker_module.rospy, "get_name", lambda: "/node")
    sentences = []
    ticker = Ticker(slot(100), sentences.append, lambda: simulated.wall_s)
    for _ in range(3):
        ticker.sleep()
    assert sentences == told
