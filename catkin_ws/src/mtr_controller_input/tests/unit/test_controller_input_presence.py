"""Loss of an idle controller, by kind of controller, with /sys and /dev in a temporary folder."""
# SPDX-License-Identifier: Apache-2.0
import os

import pytest

from mtr_controller_input.core import Controller, Joy, Outcome
from mtr_controller_input.parameters import Parameters
from mtr_controller_input.presence.heartbeat import REGULAR_FOR_S, REGULAR_GAP_S, Heartbeat
from mtr_controller_input.presence.presence import UNWATCHED_AFTER_S, Presence
from mtr_controller_input.presence.reports import open_reports

TICK_S = 0.04
LOST_AFTER_S = Parameters().heartbeat_after_s
MOTION, TOUCH, PLAIN = "40", "5", "0"
RELEASED = Joy((0.0,) * 8, (0,) * 12)
RELEASING = Joy(RELEASED.axes, tuple(int(index in (8, 9)) for index in range(12)))


class System:
    """A controller in the kernel's files; its reports are written into pipes.

    inputs: properties of its further input devices. raw: it has raw reports.
    """

    def __init__(self, root, inputs=(), raw=False, bus="0005:054C:09CC.0001"):
        self.root, self.hands = root, []
        self.controller = root / "sys/devices" / bus
        own = self.controller / "input/input7/js0"
        own.mkdir(parents=True)
        (own.parent / "properties").write_text("0\n", encoding="ascii")
        (root / "sys/class/input").mkdir(parents=True)
        (root / "sys/class/input/js0").symlink_to(own)
        (root / "dev/input").mkdir(parents=True)
        self.plug()
        for number, properties in enumerate(inputs, 8):
            (self.controller / f"input/input{number}/event{number}").mkdir(parents=True)
            (self.controller / f"input/input{number}/properties").write_text(f"{properties}\n", encoding="ascii")
            self._pipe(root / f"dev/input/event{number}")
        if raw:
            (self.controller / "hidraw/hidraw3").mkdir(parents=True)
            self._pipe(root / "dev/hidraw3")

    def _pipe(self, path):
        os.mkfifo(path)
        # Both ends are opened, so that opening does not block.
        self.hands.append(os.open(path, os.O_RDWR | os.O_NONBLOCK))

    def plug(self):
        (self.root / "dev/input/js0").touch()

    def unplug(self):
        (self.root / "dev/input/js0").unlink()

    def report(self, index=0):
        """Send a report of the controller."""
        os.write(self.hands[index], b"x" * 24)


@pytest.fixture
def system(tmp_path):
    made = []

    def make(*arguments, **keywords):
        made.append(System(tmp_path, *arguments, **keywords))
        return made[-1]
    yield make
    for each in made:
        for hand in each.hands:
            os.close(hand)


class Clock:
    """A presence in operation: each tick lasts 0.04 s."""

    def __init__(self, system):
        self.system, self.now_s = system, 100.0
        self.presence = Presence("/dev/input/js0", LOST_AFTER_S, system.root)
        self.is_there = True

    def ticks(self, duration_s, reports=True, is_idle=True):
        """Run ticks for a time; return the time in s for which the controller was present."""
        there_s = 0.0
        for _ in range(round(duration_s / TICK_S)):
            self.now_s += TICK_S
            if reports and self.system.hands:
                self.system.report()
            self.is_there = self.presence.update(self.now_s, is_idle)
            there_s += TICK_S * self.is_there
        return there_s


@pytest.mark.parametrize("kind", [{"inputs": (MOTION,)}, {"inputs": (TOUCH, MOTION)}, {"raw": True},
                                  {"inputs": (TOUCH,), "raw": True}],
                         ids=["motion sensor", "touch pad and motion sensor", "raw", "touch pad and raw"])
def test_idle_controller_that_no_longer_reports_is_lost_within_0_3_s(system, kind):
    shown = system(**kind)
    of_sensor = kind.get("inputs", ()).index(MOTION) if MOTION in kind.get("inputs", ()) else len(shown.hands) - 1
    shown.hands = [shown.hands[of_sensor]]
    clock = Clock(shown)
    clock.ticks(3.0)
    assert clock.is_there and clock.presence.is_watched
    there_s = clock.ticks(2.0, reports=False)
    assert not clock.is_there and there_s <= LOST_AFTER_S + 1e-9
    assert LOST_AFTER_S <= 0.3
    clock.presence.close()


def test_loss_of_an_idle_controller_locks_the_robot_until_it_is_back_and_released(system):
    clock, controller = Clock(system(inputs=(MOTION,))), Controller(Parameters())

    def hold(joy, duration_s, reports=True):
        # The driver continuously repeats the last message.
        for _ in range(round(duration_s / TICK_S)):
            clock.ticks(TICK_S, reports)
            controller.take(joy, clock.now_s)
            outcome = controller.step(clock.now_s, clock.is_there)
        return outcome
    hold(RELEASING, 1.2)
    assert hold(RELEASED, 60.0) == Outcome()
    assert hold(RELEASED, LOST_AFTER_S + 2 * TICK_S, reports=False).lock_reason.code == "controller_input.lost"
    assert hold(RELEASED, 60.0, reports=False).lock_reason.code == "controller_input.lost"
    held = Joy(RELEASED.axes, tuple(int(index == 4) for index in range(12)))
    assert hold(held, 1.0).lock_reason.code == "controller_input.lost"
    assert hold(RELEASED, 1.0) == Outcome()


@pytest.mark.parametrize("kind", [{"bus": "1-1:1.0"}, {"inputs": (TOUCH, PLAIN)}],
                         ids=["2.4 GHz receiver", "no sensor"])
def test_loss_behind_a_receiver_that_stays_is_not_noticed_and_the_operator_is_told(system, kind):
    clock = Clock(system(**kind))
    clock.ticks(UNWATCHED_AFTER_S - 1.0, reports=False)
    assert clock.is_there and not clock.presence.is_unwatched
    clock.ticks(2.0, reports=False)
    assert clock.is_there and clock.presence.is_unwatched


def test_controller_that_reports_only_changes_is_never_lost_while_idle(system):
    clock = Clock(system(raw=True))
    clock.ticks(10.0, is_idle=False)
    assert not clock.presence.is_watched
    clock.ticks(10.0, reports=False)
    assert clock.is_there
    clock.presence.close()


def test_device_that_disappears_is_lost_at_once_and_another_one_starts_again(system):
    shown = system(inputs=(MOTION,))
    clock = Clock(shown)
    clock.ticks(3.0)
    shown.unplug()
    assert clock.ticks(TICK_S) == 0.0
    shown.plug()
    clock.ticks(TICK_S)
    assert clock.is_there and not clock.presence.is_watched
    clock.ticks(3.0)
    assert clock.presence.is_watched
    clock.presence.close()


def test_controller_that_is_not_looked_at_is_there(tmp_path):
    presence = Presence("", LOST_AFTER_S, tmp_path)
    assert all(presence.update(now_s, True) for now_s in (0.0, 1.0, 100.0)) and not presence.is_unwatched


def test_device_may_be_named_by_a_link(system):
    shown = system(inputs=(MOTION,))
    (shown.root / "dev/input/pad").symlink_to(shown.root / "dev/input/js0")
    reports = open_reports("/dev/input/pad", shown.root)
    shown.report()
    assert reports.has_reported() and not reports.has_reported()
    reports.close()


def test_reports_without_permission_or_of_a_strange_system_are_none(system):
    shown = system(inputs=(MOTION, "", "zz"))
    for number in (8, 9, 10):
        (shown.root / f"dev/input/event{number}").unlink()
    assert open_reports("/dev/input/js0", shown.root) is None
    assert open_reports("/dev/input/js9", shown.root) is None


def beats(heartbeat, duration_s, period_s=TICK_S, is_idle=True, start_s=0.0):
    """Return the time after regular reports."""
    now_s = start_s
    while now_s < start_s + duration_s - 1e-9:
        now_s += period_s
        assert not heartbeat.update(now_s, True, is_idle)
    return now_s


@pytest.mark.parametrize("period_s, is_regular", [(0.01, True), (0.09, True), (REGULAR_GAP_S + 0.01, False),
                                                  (0.5, False)])
def test_only_regular_reports_are_a_heartbeat(period_s, is_regular):
    heartbeat = Heartbeat(LOST_AFTER_S)
    beats(heartbeat, 2.0 * REGULAR_FOR_S, period_s)
    assert heartbeat.is_watched is is_regular


@pytest.mark.parametrize("silent_s, is_lost", [(0.0, False), (LOST_AFTER_S - 0.01, False), (LOST_AFTER_S + 0.01, True),
                                               (3600.0, True), (float("nan"), True), (-1.0, True)])
def test_silence_of_a_heartbeat_is_a_loss(silent_s, is_lost):
    heartbeat = Heartbeat(LOST_AFTER_S)
    now_s = beats(heartbeat, 3.0)
    assert heartbeat.update(now_s + silent_s, False, True) is is_lost


def test_stick_that_trembled_for_a_while_costs_one_loss_and_not_more():
    heartbeat = Heartbeat(LOST_AFTER_S)
    now_s = beats(heartbeat, 3.0)
    assert heartbeat.update(now_s + 1.0, False, True)
    assert not heartbeat.update(now_s + 2.0, True, False) and not heartbeat.is_watched
    assert not heartbeat.update(now_s + 100.0, False, True)
