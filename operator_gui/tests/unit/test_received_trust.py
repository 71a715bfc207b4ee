"""Who else may have written a file, whose report a folder holds, and how texts of people are shown."""
# SPDX-License-Identifier: Apache-2.0
import csv
import dataclasses
import datetime
import os
import pathlib
import re
import shutil

import matplotlib.text
import measured
import pytest

from mtr_operator.cli import main
from mtr_operator.domain.eventlog.entry import WARNING, EventEntry, EventKind
from mtr_operator.domain.identity.identity import Equipment, Identity
from mtr_operator.domain.results.document import MAX_TEXT, shown_text
from mtr_operator.domain.results.progress import JournalMark
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence import contents
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.history.index import Index
from mtr_operator.history.search import repetitions
from mtr_operator.report import files, protocol_page
from mtr_operator.report.drawing.plain_figure import plain_figure
from mtr_operator.report.files import write_report
from mtr_operator.station.test import open_test, report_folder
from mtr_operator.storage import lock
from mtr_operator.storage.journal import second_place
from mtr_operator.storage.lock import Lock, is_held
from mtr_operator.storage.progress_file import open_progress, save_progress
from mtr_operator.storage.recorded.event_file import EventFile, read_events
from mtr_operator.storage.recorded.spreadsheet import guarded, unguarded

MARK = JournalMark("a1", 3)
STRANGER = 65534
as_root = pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root gives files away")


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A journal in a second place, and the test with that journal's beginning."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setenv("TMPDIR", str(tmp_path / "tmp"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    path = measured.journalled(tmp_path / "test", (5.0,))
    content = (path.parent / "progress.journal").read_bytes()
    (path.parent / "progress.journal").write_bytes(b"".join(content.splitlines(keepends=True)[:3]))
    path.unlink()
    file, place = second_place.open_second_place("progress", MARK, content)
    file.close()
    return place


def notice_of(tmp_path):
    """What is said when the test continues, and how many lines it has."""
    test = open_test(tmp_path / "test" / "progress.journal")
    return test.progress.notice, len(test.progress.results)


def test_journal_in_a_second_place_is_private_and_continues_the_test(kept, tmp_path):
    assert kept.parent.stat().st_mode & 0o777 == 0o700
    assert "is taken from" in notice_of(tmp_path)[0] and notice_of(tmp_path)[1] == 1


@as_root
@pytest.mark.parametrize("given_away", ["file", "folder"])
def test_journal_of_another_user_is_not_used_and_that_is_said(kept, tmp_path, given_away):
    os.chown(kept if given_away == "file" else kept.parent, STRANGER, STRANGER)
    notice, results = notice_of(tmp_path)
    assert results == 0 and "is not used: it belongs to another user." in notice


@pytest.mark.parametrize("mode", [0o722, 0o720, 0o702, 0o777])
@pytest.mark.parametrize("opened", ["file", "folder"])
def test_journal_that_other_users_can_write_is_not_used(kept, tmp_path, opened, mode):
    (kept if opened == "file" else kept.parent).chmod(mode)
    notice, results = notice_of(tmp_path)
    assert results == 0 and "is not used: other users may write it." in notice


@pytest.mark.parametrize("linked", ["file", "folder"])
def test_journal_behind_a_link_is_not_used(kept, tmp_path, linked):
    place = kept if linked == "file" else kept.parent
    place.rename(tmp_path / "elsewhere")
    place.symlink_to(tmp_path / "elsewhere")
    notice, results = notice_of(tmp_path)
    assert results == 0 and "is not used: it is a link." in notice


def test_earlier_versions_kept_journals_among_temporary_files(kept, tmp_path):
    former = tmp_path / "tmp" / second_place.FOLDER_NAME
    former.parent.mkdir()
    shutil.move(str(kept.parent), str(former))
    assert "is taken from" in notice_of(tmp_path)[0]
    former.chmod(0o777)
    assert notice_of(tmp_path)[1] == 0


@as_root
def test_nothing_is_kept_in_a_folder_of_another_user(tmp_path, monkeypatch):
    places = tmp_path / "first" / second_place.FOLDER_NAME, tmp_path / "second"
    monkeypatch.setattr(second_place, "second_places", lambda: places)
    places[0].mkdir(parents=True)
    os.chown(places[0], STRANGER, STRANGER)
    monkeypatch.setattr(pathlib.Path, "chmod", lambda *_: None)
    file, place = second_place.open_second_place("progress", MARK, b"x")
    file.close()
    assert place.parent == places[1] and not any(places[0].iterdir())


@pytest.mark.parametrize("can_unlink", [True, False])
def test_lock_file_goes_with_the_lock_also_where_an_open_file_cannot_be_deleted(tmp_path, monkeypatch, can_unlink):
    path, opened, unlink = tmp_path / "progress.json", set(), pathlib.Path.unlink
    close = os.close

    def refuse(self, missing_ok=False):
        if opened and not can_unlink:
            raise PermissionError("it is open")
        unlink(self, missing_ok)
    monkeypatch.setattr(lock, "_CAN_UNLINK_OPEN_FILES", can_unlink)
    with Lock(path) as held:
        opened.add(held._descriptor)
        monkeypatch.setattr(pathlib.Path, "unlink", refuse)
        monkeypatch.setattr(os, "close", lambda each: (opened.discard(each), close(each)))
        assert is_held(path)
    assert not is_held(path)


@pytest.fixture
def two_tests(tmp_path):
    """Of the command line: both files have the same name."""
    paths = [measured.in_folder(tmp_path / f"demo_{number}", 5.0, mark=f"m{number}",
                                started=f"2026-11-2{number}T10:00:00+01:00") for number in (1, 2)]
    for path in paths:
        path.with_suffix(".journal").write_bytes(b"")
    return [open_test(path) for path in paths]


def report(folder, test, *names):
    """A report with these files, as the window writes one."""
    place = report_folder(folder, test)
    place.mkdir(parents=True, exist_ok=True)
    save_progress(place / "progress.json", test.progress)
    for name in names:
        (place / name).write_text(test.progress.session["started"], encoding="utf-8")
    return place


def test_reports_of_two_tests_of_the_command_line_lie_apart(two_tests, tmp_path):
    places = [report(tmp_path / "results", test, "protocol.svg") for test in two_tests]
    assert [place.name for place in places] == ["key_press_2026-11-21_10-00-00", "key_press_2026-11-22_10-00-00"]
    assert [report(tmp_path / "results", test, "protocol.svg") for test in two_tests] == places
    days = [(place / "protocol.svg").read_text(encoding="utf-8")[:10] for place in places]
    assert days == ["2026-11-21", "2026-11-22"]


@pytest.mark.parametrize("started", ["same second", "../../x", "C:\\x", "a\0b", 500 * "x", "", "\u202e"])
def test_report_lies_in_the_folder_of_results_whatever_the_start_is(two_tests, tmp_path, started):
    for test in two_tests:
        test.progress.session["started"] = started
    places = [report(tmp_path / "results", test) for test in two_tests]
    assert len({*places}) == 2 and {place.parent for place in places} == {tmp_path / "results"}


@pytest.mark.parametrize("there", ["protocol.svg of an earlier version", "a test with a journal", "a file"])
def test_what_is_no_report_of_this_test_is_left_alone(two_tests, tmp_path, there):
    test = two_tests[0]
    place = report_folder(tmp_path / "results", test)
    place.parent.mkdir()
    if there == "a file":
        place.write_text("mine", encoding="utf-8")
    else:
        place.mkdir()
        (place / ("protocol.svg" if "svg" in there else "progress.journal")).write_text("mine", encoding="utf-8")
        if "journal" in there:
            save_progress(place / "progress.json", test.progress)
    assert report_folder(tmp_path / "results", test).name == f"{place.name}_2"


def test_history_lists_the_test_and_not_the_copy_in_its_report(two_tests, tmp_path):
    for test in two_tests:
        report(tmp_path / "results", test)
    entries = Index([tmp_path / "results", tmp_path]).refresh()
    assert {entry.file for entry in entries} == {test.path for test in two_tests}


def test_history_is_in_the_order_of_time_when_clocks_are_set_back_and_between_zones(tmp_path):
    started = ["2026-10-25T02:50:00+02:00", "2026-10-25T02:10:00+01:00", "2026-10-24T20:30:00-05:00",
               "2026-10-25T03:00:00"]
    for number, moment in enumerate(started):
        measured.in_folder(tmp_path / str(number), 5.0, mark=f"m{number}", started=moment)
    entries = Index([tmp_path]).refresh()
    assert [entry.started for entry in entries] == [started[index] for index in (3, 2, 1, 0)]
    assert [entry.started for entry in repetitions(entries, entries[0])] == started[:2] + started[2:]


MATHEMATICS = ["GT$\\x$", "K$%Q$", "$a$", "$", "$$", "\\frac{1}{2}", "a_b^c", "$\\frac{1}$", "<b>", "_", "%"]


@pytest.mark.parametrize("text", MATHEMATICS)
def test_name_with_dollar_signs_is_in_all_pictures_as_it_was_typed(tmp_path, monkeypatch, text):
    who = Identity(text, text, text, text, text, None, text, text, text, text, (Equipment(text, text),))
    path = measured.in_folder(tmp_path / "test", 5.0, 5.5, identity=who)
    figures = []
    monkeypatch.setattr(protocol_page, "plain_figure", lambda *arguments, **options: figures.append(
        plain_figure(*arguments, **options)) or figures[-1])
    problems = []
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    write_report(path.parent, scenario, parameters, progress, problems.append)
    assert not problems and figures
    drawn = [each for figure in figures for each in figure.findobj(matplotlib.text.Text)]
    assert not [each for each in drawn if each.get_parse_math()] and any(text in each.get_text() for each in drawn)
    assert main(["bundle", str(path)]) == 0


def test_only_one_module_makes_figures():
    sources = pathlib.Path(files.__file__).parents[2]
    texts = {path.name: path.read_text(encoding="utf-8") for path in sources.rglob("*.py")}
    makers = [name for name, text in texts.items()
              if "from matplotlib.figure import" in text and re.search(r"\bFigure\(", text)]
    assert makers == ["plain_figure.py"]


@pytest.mark.parametrize("name", ["protocol.png", "results.csv", "budget.json", "protocol.pdf"])
def test_part_of_a_report_that_fails_costs_neither_the_others_nor_the_bundle(tmp_path, monkeypatch, name):
    def broken(*arguments):
        def fail():
            raise ZeroDivisionError("not planned")
        return {**files.report_files(*arguments), name: fail}
    made = files.report_files
    monkeypatch.setattr(contents, "report_files", broken)
    path = measured.in_folder(tmp_path / "test", 5.0)
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    manifest = write_bundle(tmp_path / "a.mtr.zip", path, scenario, progress, None, station=Station(tmp_path / "key"))
    assert name not in manifest.files and {"left_out.json", "record.json"} <= manifest.files.keys()
    problems, out = [], tmp_path / "out"
    out.mkdir()
    monkeypatch.setattr(files, "report_files", lambda *arguments: {**made(*arguments), name: lambda: 1 // 0})
    write_report(out, scenario, parameters, progress, problems.append)
    assert {each.name for each in out.iterdir()} == set(files.FILE_NAMES) - {name}
    assert [each for each in problems if each.startswith(f"{name} is missing")]


FORMULAS = ["=1+1", "=HYPERLINK(\"http://192.0.2.1\")", "@SUM(1)", "+cmd|' /C calc'!A0", "-1+cmd|x", "=cmd|x", " =1",
            "\t=1", "\r=1", "'=1", "''=1"]


@pytest.mark.parametrize("text", [*FORMULAS, "-1.5", "+3", "-0.1 -0.2", "plain", "'quoted'", "a=b", "", "'"])
def test_cell_is_no_formula_and_comes_back_as_it_was(text):
    assert unguarded(guarded(text)) == text
    assert (guarded(text) == text) is (text not in FORMULAS)


@pytest.mark.parametrize("text", FORMULAS)
def test_event_list_holds_no_formula(tmp_path, text):
    entry = EventEntry(datetime.datetime(2026, 11, 22, 10, tzinfo=datetime.timezone.utc), 1.0, EventKind.FAULT,
                       WARNING, text, text)
    file = EventFile(tmp_path / "events_001.csv")
    file.add(entry)
    file.close()
    with open(file.path, encoding="utf-8", newline="") as written:
        for row in csv.DictReader(written):
            assert not {row["source"].lstrip()[:1], row["text"].lstrip()[:1]} & set("=@+-")
    assert [*read_events(file.path)] == [dataclasses.replace(entry, text=" ".join(text.split()))]


@pytest.mark.parametrize("text, shown", [
    ("as it is", "as it is"), ("a\nb\tc", "a b c"), ("a\0b\x1b[2J", "a\ufffdb\ufffd[2J"),
    ("\u202egpj.exe", "\ufffdgpj.exe"), ("\ud800", "\ufffd"), (10 ** 6 * "x", MAX_TEXT * "x" + "...")])
def test_text_of_a_file_is_shown_on_one_line(text, shown):
    assert shown_text(text) == shown
