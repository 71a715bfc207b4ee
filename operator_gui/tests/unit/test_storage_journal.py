"""The journal on disk: whole entries or none, recovered up to damage, and the test from it alone (C1)."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import random

import pytest

from mtr_operator.domain.errors import InUse, OutputError, ProgressFileError
from mtr_operator.domain.results.document import read_record
from mtr_operator.domain.results.journal import DECISION, LINE, LINE_BEGUN, POINT, SUPERSEDED
from mtr_operator.domain.results.notebook import Notebook
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.station.connection import Connection
from mtr_operator.station.test import Test, new_test, report_folder
from mtr_operator.storage.journal import journal_file
from mtr_operator.storage.journal.journal_file import journal_path, read_journal
from mtr_operator.storage.progress_file import load_progress, open_progress, save_progress
from mtr_operator.storage.store import Store

SCENARIO = SCENARIOS["key_press"]
PARAMETERS = KeyPressParameters().to_mapping()


def result(number, distance_m=5.0):
    return {"radial": number, "angle_deg": 45.0, "status": "ok", "distance_m": distance_m, "failed_distance_m": None,
            "uncertainty_m": 0.03, "attempts": 3, "robot_time_s": 12.345678, "reason": ""}


def new_progress(lines=0):
    return Progress("key_press", dict(PARAMETERS), {"started": "today"}, CarDimensions(4.5, 1.8, 0.02, 0.01),
                    [read_record(KeyPressResult, result(number)) for number in range(1, lines + 1)])


def measure(notebook, number):
    notebook.add(LINE_BEGUN, {"line": number})
    notebook.add(POINT, {"word": "press", "status": "ok", "distance": {"distance_m": 5.0}, "frame": None})
    notebook.add(LINE, {"result": result(number), "frame": None})


@pytest.fixture
def path(tmp_path):
    return tmp_path / "progress.json"


@pytest.fixture
def killed(path):
    """Journal of a test that was killed in its third line; the progress file knows the first one."""
    progress = new_progress()
    with Store(path, progress) as store:
        notebook = Notebook(progress, KeyPressResult, store)
        measure(notebook, 1)
        store.save()
        measure(notebook, 2)
        notebook.add(LINE_BEGUN, {"line": 3})
        notebook.add(POINT, {"word": "press", "status": "ok", "distance": {"distance_m": 4.0}, "frame": None})
    return path


def loaded(path):
    return load_progress(path, SCENARIO, PARAMETERS)


def test_line_that_is_only_in_the_journal_is_there_after_the_next_start(killed):  # C1, N6
    progress = loaded(killed)
    assert progress.measured() == [1, 2]
    assert json.loads(killed.read_text(encoding="utf-8"))["results"] == [result(1)]
    assert progress.notice == ""


def test_point_of_the_line_at_hand_is_there_after_the_next_start(killed):  # C1
    progress = loaded(killed)
    assert (progress.line_at_hand, progress.points["press"].distance) == (3, {"distance_m": 4.0})


def test_lost_progress_file_is_recovered_from_the_journal_and_said(killed):
    killed.unlink()
    _, _, progress = open_progress(killed, SCENARIOS)
    assert progress.measured() == [1, 2]
    assert "was recovered from its journal" in progress.notice


def test_journal_may_be_named_instead_of_the_progress_file(killed):
    assert loaded(journal_path(killed)).measured() == [1, 2]


@pytest.mark.parametrize("cut", range(1, 60, 7))
def test_torn_last_entry_is_left_out_and_said_and_the_test_goes_on(killed, cut):
    journal = journal_path(killed)
    content = journal.read_bytes()
    journal.write_bytes(content[:-cut])
    progress = loaded(killed)
    assert (progress.measured(), progress.points) == ([1, 2], {})
    assert "its last entry was cut off" in progress.notice
    with Store(killed, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 4)
    assert not read_journal(journal).is_damaged
    assert loaded(killed).measured() == [1, 2, 4]


def test_flipped_byte_is_found_wherever_it_is_and_nothing_wrong_is_taken(killed):
    chance = random.Random(1)
    journal = journal_path(killed)
    content = journal.read_bytes()
    whole = {json.dumps(entry.values) for entry in read_journal(journal).entries}
    for _ in range(300):
        place, bit = chance.randrange(len(content)), 1 << chance.randrange(8)
        journal.write_bytes(content[:place] + bytes([content[place] ^ bit]) + content[place + 1:])
        recovered = read_journal(journal)
        assert recovered.is_damaged
        assert {json.dumps(entry.values) for entry in recovered.entries} < whole
        assert loaded(killed).measured() in ([1], [1, 2])


def test_journal_that_is_longer_than_any_of_its_lines_may_be_is_read_and_the_test_goes_on(killed, monkeypatch):
    progress = loaded(killed)
    with Store(killed, progress) as store:
        notebook = Notebook(progress, KeyPressResult, store)
        for number in range(4, 40):
            measure(notebook, number)
    longest = max(map(len, journal_path(killed).read_bytes().splitlines()))
    monkeypatch.setattr(journal_file, "MAX_LINE_BYTES", longest + 1)
    assert journal_path(killed).stat().st_size > 3 * longest
    progress = loaded(killed)
    assert progress.notice == "" and progress.measured() == [1, 2, *range(4, 40)]
    with Store(killed, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 40)
    assert 40 in loaded(killed).measured()


def test_line_that_is_too_long_ends_what_is_recovered(killed):
    journal = journal_path(killed)
    whole = read_journal(journal)
    with journal.open("ab") as file:
        file.truncate(len(whole.content) + 3 * journal_file.MAX_LINE_BYTES)
    recovered = read_journal(journal)
    assert (recovered.entries, recovered.content) == (whole.entries, whole.content)
    assert recovered.is_damaged and not recovered.is_torn


def test_large_file_that_is_no_journal_is_a_sentence_and_is_not_read_to_its_end(killed):
    journal = journal_path(killed)
    journal.write_bytes(b"")
    os.truncate(journal, 1 << 40)
    with pytest.raises(ProgressFileError, match="is larger than 16 MiB"):
        read_journal(journal)
    assert loaded(killed).measured() == [1]


def test_damaged_journal_is_kept_aside_when_the_test_goes_on(killed):
    journal = journal_path(killed)
    content = bytearray(journal.read_bytes())
    content[len(content) // 2] ^= 1
    journal.write_bytes(content)
    progress = loaded(killed)
    assert "is damaged; its first" in progress.notice
    with Store(killed, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 7)
    assert (killed.parent / "progress.journal.damaged-1").read_bytes() == bytes(content)
    assert 7 in loaded(killed).measured()


def test_progress_file_that_reaches_farther_than_a_damaged_journal_counts(path):
    progress = new_progress()
    with Store(path, progress) as store:
        for number in (1, 2, 3):
            measure(Notebook(progress, KeyPressResult, store), number)
        store.save()
    journal = journal_path(path)
    journal.write_bytes(journal.read_bytes()[:600])
    progress = loaded(path)
    assert progress.measured() == [1, 2, 3]
    with Store(path, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 4)
    path.unlink()
    assert loaded(path).measured() == [1, 2, 3, 4]


def test_test_of_a_version_without_journals_goes_on_with_one(path):
    save_progress(path, new_progress(lines=2))
    progress = loaded(path)
    with Store(path, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 3)
    assert loaded(path).measured() == [1, 2, 3]


def test_journal_of_another_test_beside_a_progress_file_is_a_sentence(killed):
    save_progress(killed, new_progress(lines=3))
    with pytest.raises(ProgressFileError, match="journal beside it belongs to another test"):
        loaded(killed)


def test_start_that_finds_nothing_writes_nothing(killed):  # C2
    before = {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in killed.parent.iterdir()}
    with Store(killed, loaded(killed)) as store:
        store.add(DECISION, {"action": "wait for robot and Car"})
    assert {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in killed.parent.iterdir()} == before


def test_second_holder_of_a_test_is_refused_and_the_first_goes_on(killed):  # C2
    mine, other = loaded(killed), loaded(killed)
    with Store(killed, mine) as store:
        with pytest.raises(InUse, match=f"process {os.getpid()}"), Store(killed, other):
            pass
        measure(Notebook(mine, KeyPressResult, store), 3)
    assert loaded(killed).measured() == [1, 2, 3]


def test_nothing_is_written_over_a_test_that_went_on_elsewhere(killed):  # C2
    stale, progress = loaded(killed), loaded(killed)
    with Store(killed, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 3)
        store.save()
    with pytest.raises(InUse, match="gone on with since"), Store(killed, stale):
        pass
    assert loaded(killed).measured() == [1, 2, 3]


def test_newer_progress_file_put_there_while_measuring_is_not_replaced(killed):  # C2
    progress = loaded(killed)
    with Store(killed, progress) as store:
        document = json.loads(killed.read_text(encoding="utf-8"))
        document["journal"]["entries"] = 1000
        killed.write_text(json.dumps(document), encoding="utf-8")
        with pytest.raises(InUse):
            store.save()
    assert json.loads(killed.read_text(encoding="utf-8"))["journal"]["entries"] == 1000


def test_new_test_is_not_begun_over_a_journal_with_findings(killed):
    killed.unlink()
    with pytest.raises(OutputError, match="holds results of another test"), Store(killed, new_progress()):
        pass


def test_new_test_may_replace_a_journal_in_which_nothing_was_measured(path):
    progress = new_progress()
    with Store(path, progress) as store:
        store.add(LINE_BEGUN, {"line": 1})
    progress = new_progress()
    with Store(path, progress) as store:
        measure(Notebook(progress, KeyPressResult, store), 1)
    assert loaded(path).measured() == [1]


@pytest.mark.parametrize("run", [1, 2])
def test_superseded_point_stays_in_the_journal_when_nothing_else_was_measured(path, run):
    progress = new_progress()
    with Store(path, progress) as store:
        notebook = Notebook(progress, KeyPressResult, store)
        notebook.add(LINE_BEGUN, {"line": 1})
        notebook.add(POINT, {"word": "press", "status": "ok", "distance": {"distance_m": 5.0}, "frame": None})
        if run == 1:
            notebook.add(SUPERSEDED, {"line": 1})
            store.discard_if_empty()
    if run == 2:
        progress = loaded(journal_path(path))
        with Store(path, progress) as store:
            notebook = Notebook(progress, KeyPressResult, store)
            notebook.add(SUPERSEDED, {"line": 1})
            notebook.add(LINE_BEGUN, {"line": 1})
            store.discard_if_empty()
    assert not progress.has_findings
    assert POINT in [entry.kind for entry in read_journal(journal_path(path)).entries]


def test_test_that_has_never_measured_anything_leaves_no_file(path):
    progress = new_progress()
    with Store(path, progress) as store:
        Notebook(progress, KeyPressResult, store).add(LINE_BEGUN, {"line": 1})
        store.save()
        store.discard_if_empty()
    assert list(path.parent.iterdir()) == []


def test_number_that_is_none_is_a_sentence(path):
    with Store(path, new_progress()) as store, pytest.raises(OutputError, match="no finite number"):
        store.add(POINT, {"word": "press", "status": "ok", "distance": {"distance_m": float("nan")}, "frame": None})


def test_two_tests_of_one_second_have_names_and_reports_of_their_own(tmp_path):  # C2
    scenario, tests = SCENARIO, []
    for started in ("today", "another day"):
        test = new_test(scenario, KeyPressParameters(), tmp_path, Connection())
        test.progress.session["started"] = started
        test.save()
        tests.append(test)
        folder = report_folder(tmp_path / "results", test)
        folder.mkdir(parents=True)
        save_progress(folder / "progress.json", test.progress)
        assert report_folder(tmp_path / "results", test) == folder
    assert len({test.path for test in tests}) == 2
    assert len(list((tmp_path / "results").iterdir())) == 2
    again = Test(scenario, KeyPressParameters(), tests[1].progress, tests[0].path)
    assert report_folder(tmp_path / "results", again).name == f"{tests[0].name}_2"
