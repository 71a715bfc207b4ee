"""Tests of before that are damaged: each is named with one sentence why, and none hides the others."""
# SPDX-License-Identifier: Apache-2.0
import errno
import json
import math
import os

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.evidence.bundle import bundle_path, write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.history.index import Index
from mtr_operator.history.line_pairs import open_side
from mtr_operator.history.places import look, stamps
from mtr_operator.history.search import problems_of, unreadable
from mtr_operator.report.files import write_report
from mtr_operator.storage.progress_file import save_progress

SCENARIO = SCENARIOS["key_press"]
PARAMETERS = SCENARIO.parameters_type(method="adaptive", angle_between_radials_rad=math.pi / 2.0)
RESULTS = [KeyPressResult(number, 90.0 * (number - 1), LineStatus.OK, 5.0, 5.5, 0.01, 9, 1.0, "", method="adaptive",
                          reach="measured", d50_m=5.0, d50_sigma_m=0.15, d50_low_m=4.7, d50_high_m=5.3)
           for number in (1, 2, 3, 4)]


def written(path, mark="a1"):
    path.parent.mkdir(parents=True, exist_ok=True)
    progress = Progress(SCENARIO.name, PARAMETERS.to_mapping(),
                        {"started": "2026-11-22T15:36:43+01:00", "software": "mtr-operator 0.2.0"},
                        CarDimensions(4.5, 1.8, 0.02, 0.01), list(RESULTS), kept=JournalMark(mark, 14))
    save_progress(path, progress)
    return progress


@pytest.fixture
def tests(tmp_path):
    """A folder with one good test; what is put beside it must not hide it."""
    folder = tmp_path / "tests"
    written(folder / "good.json", "good")
    return folder


def problem_beside_the_good_one(folder):
    entries = Index([folder]).refresh()
    assert [entry.test_id for entry in entries if not entry.problem] == ["good"]
    [problem] = problems_of(entries)
    assert problem.endswith(".") and "\n" not in problem and "Error" not in problem
    return problem


@pytest.fixture
def bundled(tmp_path, monkeypatch):
    """A test's folder with its bundle; function that gives the bundle."""
    def make(folder):
        path = folder / "progress.json"
        progress = written(path, "bundled")
        assessment = write_report(folder, SCENARIO, PARAMETERS, progress)
        target = bundle_path(path)
        write_bundle(target, path, SCENARIO, progress, assessment, station=Station(tmp_path / "station"))
        return target
    return make


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")
@pytest.mark.parametrize("name", ["pipe.json", "pipe.journal"])
def test_pipe_among_the_tests_is_named_and_not_waited_for(tests, name):
    os.mkfifo(tests / name)
    assert f"{name} " in problem_beside_the_good_one(tests) or f"{name}." in problem_beside_the_good_one(tests)
    assert "it is a pipe or a device, and no file" in problem_beside_the_good_one(tests)


@pytest.mark.parametrize("spoil, said", [
    (lambda text: text[:len(text) // 2], "truncated"),
    (lambda text: text.replace('"version": 1', '"version": 2'), "this application reads version 1"),
    (lambda text: text.replace('"distance_m"', '"distence_m"'), "damaged"),
    (lambda text: "", "truncated"),
])
def test_damaged_record_is_named(tests, spoil, said):
    path = tests / "mine" / "progress.json"
    written(path)
    path.write_text(spoil(path.read_text(encoding="utf-8")), encoding="utf-8")
    problem = problem_beside_the_good_one(tests)
    assert said in problem and str(path) in problem


def test_link_to_itself_does_not_end_the_list(tests):
    (tests / "loop").symlink_to("loop")
    (tests / "loop.json").symlink_to("loop.json")
    assert "loop.json" in problem_beside_the_good_one(tests)


@pytest.mark.parametrize("where", ["", "mine", "mine/progress.json"])
def test_folder_that_nobody_may_read_is_named(tests, monkeypatch, where):
    written(tests / "mine" / "progress.json")
    shut = os.path.join(tests, where) if where else str(tests)
    listdir, stat = os.listdir, os.stat

    def refused(function):
        def refuse(path, *args, **kwargs):
            if os.fspath(path) == shut or os.fspath(path).startswith(f"{shut}{os.sep}"):
                raise PermissionError(errno.EACCES, "Permission denied", path)
            return function(path, *args, **kwargs)
        return refuse

    monkeypatch.setattr("os.listdir", refused(listdir))
    monkeypatch.setattr("os.stat", refused(stat))
    found = look([tests])
    monkeypatch.undo()
    assert list(found.problems.values()), where
    assert all("Permission denied." in problem and shut in problem for problem in found.problems.values())
    assert [os.path.basename(path) for path in found.stamps] == (["good.json"] if where else [])


def test_folder_that_vanishes_while_it_is_listed_is_no_fault_and_a_file_that_does_is_named(tests, monkeypatch):
    written(tests / "mine" / "progress.json")
    listdir = os.listdir
    monkeypatch.setattr("os.listdir", lambda path: [*listdir(path), "gone", "gone.json"])
    entries = Index([tests]).refresh()
    assert sorted(entry.test_id for entry in entries) == ["a1", "good"]
    index = Index([tests])
    monkeypatch.setattr("mtr_operator.history.index.look", lambda folders: _vanishing(look(folders), tests))
    assert "No such file" in problems_of(index.refresh())[0]


def _vanishing(found, tests):
    (tests / "mine" / "progress.json").unlink()
    return found


def test_report_without_its_test_is_named(tests):
    (tests / "mine").mkdir()
    (tests / "mine" / "results.csv").write_text("line\n", encoding="utf-8")
    assert "holds results.csv, and no progress.json" in problem_beside_the_good_one(tests)


def test_test_whose_report_is_gone_is_listed(tests):
    written(tests / "mine" / "progress.json")
    assert not problems_of(Index([tests]).refresh())


def test_name_that_is_no_text_hides_nothing_and_is_kept(tests, tmp_path, capsys):
    try:
        (tests / os.fsdecode(b"caf\xe9.json")).write_bytes(b"{")
        written(tests / os.fsdecode(b"good_\xe9") / "progress.json")
    except OSError:
        pytest.skip("this file system takes text only")
    cache = tmp_path / "cache.json"
    assert len(Index([tests], cache).refresh()) == 3
    again = Index([tests], cache)
    assert len(again.refresh()) == 3 and again.read == 0
    assert main(["history", "--folder", str(tests)]) == 0
    assert main(["history", "--json", "--folder", str(tests)]) == 0
    assert "good_\\udce9" in capsys.readouterr().out


def test_bundle_alone_is_a_test_and_beside_its_test_the_same_one(tests, bundled):
    bundle = bundled(tests / "mine")
    entries = Index([tests]).refresh()
    assert [(entry.test_id, entry.path) for entry in entries if entry.test_id == "bundled"] == \
        [("bundled", str(tests / "mine" / "progress.json"))]
    os.rename(bundle, tests / "kept.mtr.zip")
    for file in (tests / "mine").iterdir():
        file.unlink()
    [entry] = [entry for entry in Index([tests]).refresh() if entry.test_id == "bundled"]
    assert entry.file == tests / "kept.mtr.zip" and entry.done == 4
    assert len(open_side(entry.file).progress.results) == 4
    assert len(stamps([tests])) == 1


@pytest.mark.parametrize("spoil, said", [
    (lambda content: content[:len(content) // 2], "is torn, or no bundle"),
    (lambda content: b"", "is torn, or no bundle"),
    (lambda content: content.replace(b'"d50_m": 5.0', b'"d50_m": 6.0', 1), "is changed."),
    (lambda content: content.replace(b"mtr evidence bundle", b"mtr evidence bumble", 1), "is changed"),
])
def test_damaged_bundle_is_named_with_what_is_changed(tests, bundled, tmp_path, spoil, said):
    content = bundled(tmp_path / "mine").read_bytes()
    (tests / "mine.mtr.zip").write_bytes(spoil(content))
    problem = problem_beside_the_good_one(tests)
    assert said in problem and str(tests / "mine.mtr.zip") in problem


def test_bundle_of_a_later_version_says_so(tests):
    import zipfile
    with zipfile.ZipFile(tests / "mine.mtr.zip", "w") as container:
        container.writestr("manifest.json", json.dumps({"format": "mtr evidence bundle", "version": 2}))
        container.writestr("manifest.sig", "{}")
    assert "was written by a newer version" in problem_beside_the_good_one(tests)


def test_bundle_without_a_test_is_refused_by_its_own_name(tests, bundled, tmp_path, monkeypatch):
    bundle = bundled(tmp_path / "mine")
    monkeypatch.setattr("mtr_operator.history.bundles.FILE_NAME", "other.json")
    with pytest.raises(ProgressFileError, match="mine.mtr.zip holds no"):
        open_side(bundle)


def test_what_cannot_be_read_is_searched_by_its_sentence(tests):
    (tests / "bad.json").write_bytes(b"{")
    entries = Index([tests]).refresh()
    assert len(unreadable(entries, "bad TRUNCATED")) == 1 and not unreadable(entries, "golf")
