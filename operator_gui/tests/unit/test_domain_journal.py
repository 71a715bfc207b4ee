"""Every finding is in the journal before the robot is ordered on, and shown only after it is kept (C1, N6)."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.car_link.phone.simulated import PhoneModel, SimulatedPhone
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.ports import HANDLE, LockFacts
from mtr_operator.domain.results.journal import EVENT, LINE, LINE_BEGUN, POINT, PRESS, REVISED, Journal
from mtr_operator.domain.results.notebook import apply
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS

FEW_LINES = {"autolock": {"measurements_distance_m": 10.0}, "key_press": {"angle_between_radials_deg": 90.0},
             "zone_map": {"presses_limit": 6}, "handle_request": {"measurements_distance_m": 10.0},
             "digital_key": {"angle_between_radials_deg": 90.0, "spacing_m": 4.0},
             "sleep_time": {"shortest_wait_s": 2.0, "longest_wait_s": 4.0},
             "relay_resistance": {"measurements_distance_m": 10.0, "requests_per_place": 1}}


class Diary(Journal):
    """Journal in memory; `order` has its entries among the answers to the robot and what was shown."""

    def __init__(self, fails_at=None):
        self.order, self.fails_at = [], fails_at

    def add(self, kind, values):
        if (kind, values.get("word")) == self.fails_at:
            raise OutputError("The disk is full.")
        self.order.append((kind, dict(values)))

    @property
    def entries(self):
        return [item for item in self.order if item[0] not in ("sent", "shown", "saved")]

    def kinds(self):
        return [kind for kind, _ in self.order]


class Shown(RunObserver):
    def __init__(self, diary):
        self._diary = diary

    def on_result(self, result, done, total):
        self._diary.order.append(("shown", {"line": result.number}))


@pytest.fixture
def run(world, robot_link, car_link, output, extender):
    def measure(name, diary, progress=None):
        if name in ("handle_request", "sleep_time", "relay_resistance"):
            world.unlock_m, world.facts = -1.0, LockFacts(frozenset({HANDLE}))
        if name == "digital_key":
            world.phone = SimulatedPhone(1, PhoneModel(shadow_m=50.0, dropouts=0.0))
            world.phone.connect()
        scenario = SCENARIOS[name]
        parameters = scenario.parameters_type.from_mapping(FEW_LINES[name])
        send = robot_link.send

        def note(desired):
            diary.order.append(("sent", {}))
            send(desired)
        robot_link.send = note
        run.progress = progress or Progress(name, parameters.to_mapping())
        loop = ControlLoop(robot_link, car_link, Shown(diary))
        Runner(scenario, parameters, loop, run.progress, lambda _: diary.order.append(("saved", {})),
               journal=diary).run()
        return run.progress
    return measure


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_measured_point_is_kept_before_the_next_order(run, name):  # C1
    diary = Diary()
    progress = run(name, diary)
    kinds = diary.kinds()
    for result in progress.results:
        begun = diary.order.index((LINE_BEGUN, {"line": result.number}))
        line = next(index for index in range(begun, len(kinds)) if kinds[index] == LINE)
        times = {round(values["distance"]["robot_time_s"], 6) for kind, values in diary.order[begun:line]
                 if kind == POINT and values["distance"]}
        recorded = {value for key, value in result.to_document().items() if key.endswith("robot_time_s") and value}
        # A zone's result has no time of its own, but each of its presses has.
        count = result.presses if name == "zone_map" else len(recorded)
        assert recorded <= times and len(times) >= count > 0
    # The event that makes a point is followed by it, with no order between them.
    for index, (kind, values) in enumerate(diary.order):
        if kind == POINT and values["status"] == "ok" and name == "autolock":
            assert kinds[index - 1] == EVENT


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_line_is_shown_only_after_it_is_kept_and_saved(run, name):  # N6
    diary = Diary()
    run(name, diary)
    kinds = diary.kinds()
    # What all lines together say is kept and saved when they are over.
    lines = kinds[:kinds.index(REVISED)] if REVISED in kinds else kinds
    kept = [kind for kind in lines if kind in (LINE, "saved", "shown")]
    assert kept == [LINE, "saved", "shown"] * (len(kept) // 3) and kept


def test_events_and_presses_are_in_the_journal(run):
    diary = Diary()
    run("key_press", diary)
    assert {EVENT, PRESS} <= set(diary.kinds())


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_progress_follows_from_the_entries_alone(run, name):
    diary = Diary()
    progress = run(name, diary)
    again = Progress(name, progress.parameters)
    for kind, values in diary.entries:
        apply(again, SCENARIOS[name].result_type, kind, values)
    assert again == progress


def test_robot_is_not_ordered_on_when_a_point_cannot_be_kept(run, robot_link):  # C1, C4
    diary = Diary(fails_at=(POINT, "unlock"))
    with pytest.raises(OutputError):
        run("autolock", diary)
    before = len(diary.order) - 1 - diary.kinds()[::-1].index(EVENT)
    assert LINE not in diary.kinds()
    assert diary.kinds()[before + 1:] and set(diary.kinds()[before + 1:]) <= {"sent", "decision", "session"}
    assert all(desired.stop for _, desired in robot_link.answers[-diary.kinds()[before + 1:].count("sent"):])


def test_lines_that_read_otherwise_when_all_are_measured_are_kept_and_counted_once(run, robot_link, monkeypatch):
    monkeypatch.setattr(SCENARIOS["key_press"], "concluded",
                        lambda parameters, results: [replace(results[1], lapse=0.25 * len(results))])
    diary = Diary()
    progress = run("key_press", diary)
    assert [result.lapse for result in progress.results] == [None, 1.0, None, None] and progress.retried == []
    assert diary.kinds()[-2:] == [REVISED, "saved"]
    assert robot_link.answers[-1][1].stop
    replayed = Progress("key_press", progress.parameters)
    for kind, values in diary.entries:
        apply(replayed, SCENARIOS["key_press"].result_type, kind, values)
    assert replayed == progress
