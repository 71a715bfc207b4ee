"""State of the view: the newest data of robot and Car, and the current test. Updated by batches, read by widgets."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
from typing import Callable

from mtr_operator.domain.actions.standstill import since_boot_s
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.eventlog.event_list import EventList
from mtr_operator.domain.forecast import Forecast
from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Forecasting
from mtr_operator.domain.ports import LockFacts, LockState
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.robot_status import CarDimensions, Notification
from mtr_operator.domain.verdict.judgement import TestJudgement
from mtr_operator.report.assessed import assess

from .checks.checklist import Facts, Wanted, checklist
from .checks.finding import Item
from .checks.remaining import Remaining
from .estimate import USUAL_CAR, USUAL_FACTS, TimeLeft, plan_of
from .events import (
    ActionBegun,
    EventLogged,
    LineBegun,
    LineMeasured,
    LinesPlanned,
    Outcome,
    PersonWanted,
    PresenceWanted,
    RobotSilent,
    RobotSnapshot,
    RunEnded,
    StandstillSeen,
    StationEvent,
)
from .handle_prompt import Prompt
from .mailbox import Batch
from .motion import Motion
from .readiness import RUNNING, Phase, Readiness, ReadinessWord, readiness_of
from .sight.obstacle_map import ObstacleMap
from .sight.view import View, view_of
from .test import Test
from .trail import Places, thinned

# Spacing of the trail; a long one is thinned to every other position.
TRAIL_SPACING_M = 0.1
TRAIL_LENGTH = 4000


class ViewModel:
    """State of the view, which belongs to the view's thread.

    Attributes:
        robot: newest Status of the robot with the Car's locks, None before.
        trail: positions of the robot during the test; None is a gap.
        test: the current test, None before one is started or opened.
        phase: of the test.
        results: of the test so far. newest: the one measured last, None before.
        done, total: lines; total is 0 before it is known.
        line: number of the line that is being measured, 0 without one.
        action: current action of the robot. trouble: reason of an interruption; empty if the Operator caused it.
        outcome: last end of measuring, None before.
        judgement: of the lines measured so far, None without limits.
        prompt: request to the Operator at the Car's handle or for the extender, None without one.
        is_presence_wanted: the Operator must confirm presence.
        motion: orders between two tests.
        view: the robot's view, None while not reported. obstacles: map of objects around the Car.
        echoes: the LiDARs' newest returns in base_link, also before the Car is mapped.
        events: all since the start.
        wanted: the test that is about to start. free_bytes: on the disk of the results, None if unknown.
    """

    def __init__(self, clock: Callable[[], float] = since_boot_s):
        """clock: wall time in s that continues while the laptop sleeps, so that data from before is old."""
        self._clock = clock
        self._received_s = clock()
        self._time_left = TimeLeft(())
        self._car: CarDimensions | None = None
        self.robot: RobotSnapshot | None = None
        self.trail: Places = []
        self.test: Test | None = None
        self.phase = Phase.IDLE
        self.results: tuple[LineResult, ...] = ()
        self.newest: LineResult | None = None
        self.done = self.total = self.line = 0
        self.action = self.trouble = ""
        self.outcome: Outcome | None = None
        self.judgement: TestJudgement | None = None
        self.prompt: Prompt | None = None
        self.is_presence_wanted = False
        self.motion = Motion()
        self.view: View | None = None
        self.obstacles = ObstacleMap()
        self.echoes: tuple[Point, ...] = ()
        self.events = EventList()
        self.wanted = Wanted()
        self._remaining = Remaining()
        self.free_bytes: int | None = None
        self._answered_s: float | None = None

    @property
    def current_test(self) -> Test:
        """The current test, for actions that need one."""
        if self.test is None:
            raise LookupError("no test is at hand")
        return self.test

    @property
    def silent_s(self) -> float:
        """Wall time since the last Status."""
        return self._clock() - self._received_s

    @property
    def is_stale(self) -> bool:
        """True if the data of the robot is no longer current."""
        return self.readiness.word is ReadinessWord.LOST

    @property
    def readiness(self) -> Readiness:
        """Readiness for the start of a test."""
        return readiness_of(self.robot, self.silent_s, self.phase, self.motion)

    @property
    def checklist(self) -> tuple[Item, ...]:
        """Checklist before the robot moves."""
        answered_s = None if self._answered_s is None else self._clock() - self._answered_s
        mapped = None if self.robot is None else self.robot.status.car
        wanted = self.wanted
        if self.test is not None and wanted.plan is None:
            wanted = self._remaining.of(self.test, self.results, mapped, self.facts, self.obstacles)
        return checklist(Facts(self.robot, self.silent_s, wanted, answered_s, self.free_bytes))

    @property
    def may_move(self) -> bool:
        """True while the robot may move by this application: a test runs, an order is active, or it does move."""
        return self.phase in RUNNING or (not self.is_controlled_elsewhere and self.motion.is_possible(self._clock()))

    @property
    def is_controlled_elsewhere(self) -> bool:
        """True while another application controls the robot; only that application's stop has an effect."""
        return self.robot is not None and not self.is_stale and self.robot.status.controlled_by_other

    @property
    def notifications(self) -> tuple[Notification, ...]:
        """Current sentences of the robot."""
        return () if self.robot is None else self.robot.status.notifications

    @property
    def mapped_car(self) -> CarDimensions | None:
        """The Car of the test, else the one that the robot sees; None without a measured one."""
        if self.test is not None and self._car is not None:
            return self._car
        return None if self.robot is None else self.robot.status.car

    @property
    def left_s(self) -> float | None:
        """Expected time to the end of the test."""
        return self._time_left.left_s(self._clock()) if self.phase is Phase.MEASURING else None

    @property
    def forecast(self) -> Forecast | None:
        """Expected duration and precision of each line, updated by the lines so far."""
        test = self.test
        return None if test is None else part(test.scenario, Forecasting).forecast(test.parameters, self.facts,
                                                                                   self.results)

    @property
    def facts(self) -> LockFacts:
        """Facts of the connected Car by its profile; of a usual one before."""
        known = None if self.robot is None else self.robot.facts
        return USUAL_FACTS if known is None else known

    @property
    def percent(self) -> int:
        """Percentage of measured lines."""
        return 100 * self.done // self.total if self.total else 0

    def take_up(self, test: Test) -> None:
        """Select a test, before it is started or resumed; InvalidParameter if its lines do not match the Car."""
        total = test.line_count
        self.test, self.phase, self._car = test, Phase.PAUSED, test.progress.car
        self.results = tuple(test.progress.results)
        self.done, self.total = len(self.results), total
        self.action = self.trouble = ""
        self.outcome, self.newest = None, self.results[-1] if self.results else None
        self.trail = []
        self._judge()

    def begin(self) -> None:
        """Start or resume the current test."""
        self.phase, self.trouble, self.outcome = Phase.MEASURING, "", None
        self._expect(is_prepared=False)

    def order_motion(self) -> None:
        """Record an order with motion."""
        self.motion.order(self._clock())

    def order_stop(self) -> None:
        """Record an order to stop."""
        self.motion.stop()
        if self.phase is Phase.MEASURING:
            self.phase = Phase.STOPPING

    def lay_aside(self) -> None:
        """Close the current test."""
        self.test, self.phase, self.results, self.judgement = None, Phase.IDLE, (), None
        self.done = self.total = 0

    def apply(self, batch: Batch) -> None:
        """Apply the events of a batch."""
        if batch.robot is not None:
            before, self.robot, self._received_s = self.robot, batch.robot, self._clock()
            if before is not None and {before.lock_state, batch.robot.lock_state} == {LockState.LOCKED,
                                                                                      LockState.UNLOCKED}:
                self._answered_s = self._received_s
            self.motion.learn(batch.robot.status, self._received_s)
        if batch.sight is not None:
            self.view = view_of(batch.sight)
            self.echoes = () if batch.sight.surroundings is None else batch.sight.surroundings.points
            if self.view is not None:
                self.obstacles.learn(batch.sight, self.view)
        if batch.trail_begins:
            self.trail = []
        for place in batch.trail if self.test is not None else ():
            self._pass(place)
        for event in batch.events:
            self._learn(event)

    def _pass(self, place: Point | None) -> None:
        before = self.trail[-1] if self.trail else None
        # Only one of several consecutive gaps is stored.
        if place is None and before is None:
            return
        if place is None or before is None or math.dist(before, place) >= TRAIL_SPACING_M:
            self.trail.append(place)
        if len(self.trail) > TRAIL_LENGTH:
            self.trail = thinned(self.trail)

    def _learn(self, event: StationEvent) -> None:
        if isinstance(event, LinesPlanned):
            self.done, self.total, self._car = event.done, event.total, event.car
            self._expect(is_prepared=True)
        elif isinstance(event, ActionBegun):
            self.action = event.text
        elif isinstance(event, LineBegun):
            self.line = event.number
        elif isinstance(event, LineMeasured):
            self.results, self.newest = event.results, event.newest
            self.done, self.total = event.done, event.total
            self._time_left.advance(event.done, self._clock())
            self._judge()
        elif isinstance(event, RunEnded):
            self.results, self.outcome, self.trouble = event.results, event.outcome, event.text
            self.motion.stop()
            self.phase = Phase.FINISHED if event.outcome is Outcome.COMPLETE else Phase.PAUSED
            self._judge()
        elif isinstance(event, StandstillSeen):
            self.motion.stop()
        elif isinstance(event, (PersonWanted, PresenceWanted)):
            self._ask(event)
        elif isinstance(event, EventLogged):
            self.events.add(event.entry)
        elif isinstance(event, RobotSilent):
            self._received_s = min(self._received_s, self._clock() - event.silent_s)

    def _ask(self, event: PersonWanted | PresenceWanted) -> None:
        if isinstance(event, PersonWanted):
            self.prompt = event.prompt
        else:
            self.is_presence_wanted = event.is_wanted

    def _judge(self) -> None:
        """Judge the lines. The progress belongs to the links' thread while the test runs; its limits are constant, its
        results are not."""
        test, car = self.test, self._car
        self.judgement = None
        if test is None or car is None or test.progress.limits is None:
            return
        progress = dataclasses.replace(test.progress, car=car, results=list(self.results))
        judgement = assess(test.scenario, test.parameters, progress).judgement
        if judgement is not None:
            measured = {result.number for result in self.results}
            self.judgement = TestJudgement(tuple(each for each in judgement.judgements if each.line in measured))

    def _expect(self, is_prepared: bool) -> None:
        """is_prepared: the Car is mapped and checked; only the lines are left."""
        test = self.test
        if test is None:
            return
        try:
            is_mapped = self.robot is not None and self.robot.status.car is not None
            plan = plan_of(test.scenario, test.parameters, self.mapped_car or USUAL_CAR, is_mapped,
                           self.facts)
            self._time_left = TimeLeft(plan.lines_s, 0.0 if is_prepared else plan.preparation_s)
        except InvalidParameter:  # The runner reports it.
            self._time_left = TimeLeft(())
        self._time_left.begin(self.done, self._clock())
