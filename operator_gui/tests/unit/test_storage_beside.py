"""Entries and progress files are written beside the answers: in order, told when they fail, and never twice."""
# SPDX-License-Identifier: Apache-2.0
import os
import threading
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.journal import DECISION, LINE, LINE_BEGUN, POINT
from mtr_operator.domain.results.notebook import Notebook
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.test import Test
from mtr_operator.storage.journal.beside import JournalBeside
from mtr_operator.storage.journal.journal_file import read_journal
from mtr_operator.storage.progress_document import mark_in, read_document
from mtr_operator.storage.progress_file import load_progress
from mtr_operator.storage.store import Store

SCENARIO = SCENARIOS["autolock"]
PARAMETERS = SCENARIO.parameters_type.from_mapping({"measurements_distance_m": 10.0})
TODAY_S = 1.8e9
# Nobody waits so long where nothing is wrong.
LIMIT_S = 20.0


class Disk:
    """Each sync from `hold` on takes until `release`. Attributes: syncs: all that were asked for."""

    def __init__(self, monkeypatch):
        self.syncs, self.is_held, self.was_let_go = 0, False, threading.Event()
        self._free, self._sync = threading.Event(), os.fsync
        monkeypatch.setattr("os.fsync", self._wait)

    def _wait(self, descriptor):
        self.syncs += 1
        if self.is_held:
            assert self._free.wait(LIMIT_S), "nobody let the disk go on"
        self._sync(descriptor)

    def hold(self):
        self._free.clear()
        self.is_held = True

    def release(self):
        self.is_held = False
        self._free.set()


@pytest.fixture
def disk(monkeypatch):
    made = Disk(monkeypatch)
    yield made
    made.release()


@pytest.fixture
def path(tmp_path):
    return tmp_path / "progress.json"


@pytest.fixture
def opened(path):
    """A journal in which a line has begun."""
    progress = Progress("autolock", PARAMETERS.to_mapping())
    with Store(path, progress) as store, JournalBeside(store) as journal:
        journal.add(LINE_BEGUN, {"line": 1})
        yield journal


def kinds(path):
    return [entry.kind for entry in read_journal(path.with_suffix(".journal")).entries]


def test_entry_is_safe_when_the_disk_has_written_it_and_not_before(opened, disk, path):
    assert opened.wait()
    disk.hold()
    opened.add(DECISION, {"action": "a", "robot_time_s": 1.0})
    opened.add(DECISION, {"action": "b", "robot_time_s": 2.0})
    assert not opened.wait(0.01)
    disk.release()
    assert opened.wait()
    entries = read_journal(path.with_suffix(".journal")).entries
    assert [entry.values["action"] for entry in entries[-2:]] == ["a", "b"]


def test_what_cannot_be_kept_is_told_once_and_with_where_it_is_instead(opened, path, tmp_path, monkeypatch):
    monkeypatch.setattr("mtr_operator.storage.journal.second_place.second_places", lambda: (tmp_path / "second",))
    path.with_suffix(".journal").unlink()
    opened.add(POINT, {"word": "unlock", "status": "ok", "distance": None, "frame": None})
    opened.add(DECISION, {"action": "a", "robot_time_s": 1.0})
    assert opened.wait()
    with pytest.raises(OutputError, match="What was measured is kept in "):
        opened.check()
    opened.check()
    kept, = (tmp_path / "second").iterdir()
    assert [entry.kind for entry in read_journal(kept).entries][-3:] == [LINE_BEGUN, POINT, DECISION]


@pytest.mark.parametrize("ended_by, told", [(None, OutputError), (Cancelled("Ctrl-C"), OutputError),
                                            (KeyboardInterrupt(), KeyboardInterrupt)])
def test_what_nobody_has_asked_for_is_told_at_the_end(path, monkeypatch, caplog, ended_by, told):
    monkeypatch.setattr("mtr_operator.storage.journal.second_place.second_places", lambda: ())
    progress = Progress("autolock", PARAMETERS.to_mapping())
    with pytest.raises(told), Store(path, progress) as store, JournalBeside(store) as journal:
        journal.add(LINE_BEGUN, {"line": 1})
        path.with_suffix(".journal").unlink()
        journal.add(DECISION, {"action": "a", "robot_time_s": 1.0})
        if ended_by is not None:
            raise ended_by
    assert ("cannot be written" in caplog.text) is (told is KeyboardInterrupt)


@pytest.fixture
def measure(world, robot_link, car_link, path, disk):
    """measure(hold): a whole test of a robot in real time; `hold` entries of a kind are on a disk that is held then
    until the robot has been answered three times more."""
    world.spoil = lambda status: replace(status, sent_s=TODAY_S + status.stamp_s, steady_s=status.stamp_s,
                                         waits_for_answer=False)

    def measure(hold=()):
        progress = Progress("autolock", PARAMETERS.to_mapping())
        with Store(path, progress) as store, JournalBeside(store) as journal:
            add, save, send = journal.add, journal.save, robot_link.send
            measure.ordered, measure.saved = [], 0
            until = [None]

            def held(kind):
                if kind in hold and until[0] is None:
                    disk.hold()
                    until[0] = (len(robot_link.answers) + 3, [])

            def note_add(kind, values):
                held(kind)
                add(kind, values)

            def note_save():
                held("save")
                save()
                measure.saved += 1

            def note_send(desired):
                send(desired)
                if until[0] is not None:
                    until[0][1].append((desired.waypoint, desired.stop))
                    if len(robot_link.answers) >= until[0][0]:
                        measure.ordered.append(until[0][1])
                        until[0] = None
                        disk.release()
            journal.add, robot_link.send = note_add, note_send
            loop = ControlLoop(robot_link, car_link)
            Runner(SCENARIO, PARAMETERS, loop, progress, lambda _: note_save(), journal=journal).run()
        return progress
    return measure


def test_slow_disk_keeps_nobody_waiting_and_changes_no_result(measure, path, world):
    progress = measure(hold=(POINT, LINE, "save"))
    # Each of two points and of one line, and each progress file, on eight lines.
    assert len(measure.ordered) >= 8
    for answers in measure.ordered:
        waypoints = {waypoint and waypoint.id for waypoint, stop in answers if not stop}
        assert len(waypoints) == 1, "the robot was ordered on"
    assert [result.invalid_count for result in progress.results] == [0] * 8
    loaded = load_progress(path, SCENARIO, PARAMETERS.to_mapping())
    assert loaded.to_document()["results"] == progress.to_document()["results"]


def test_progress_file_of_any_moment_with_its_journal_has_each_line_once(measure, path, monkeypatch):
    seen = []
    from mtr_operator.storage import store as module
    write = module.write_bytes

    def look(target, content):
        write(target, content)
        if target == path:
            seen.append(load_progress(path, SCENARIO, PARAMETERS.to_mapping()).measured())
    monkeypatch.setattr(module, "write_bytes", look)
    measure(hold=("save",))
    assert seen == [list(range(1, number + 1)) for number in range(1, 9)]
    assert kinds(path).count(LINE) == 8


def test_progress_that_a_person_saves_meanwhile_has_no_entry_on_its_way(path, disk):
    test = Test(SCENARIO, PARAMETERS, Progress("autolock", PARAMETERS.to_mapping()), path)
    with test.opened() as store, test.written_beside(store) as journal:
        notebook = Notebook(test.progress, SCENARIO.result_type, journal)
        notebook.add(LINE_BEGUN, {"line": 1})
        disk.hold()
        notebook.add(POINT, {"word": "unlock", "status": "ok", "distance": None, "frame": None})
        wait = journal.wait

        def release_and_wait():
            assert not wait(0.0)
            disk.release()
            return wait()
        journal.wait = release_and_wait
        test.save()
        assert mark_in(read_document(path)).entries == len(read_journal(path.with_suffix(".journal")).entries)
        journal.wait = wait
