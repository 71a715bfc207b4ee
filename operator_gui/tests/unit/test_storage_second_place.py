"""A measurement that cannot be written where it belongs is kept elsewhere, and a sentence says where (C4)."""
# SPDX-License-Identifier: Apache-2.0
import errno
import os
import shutil

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.journal import DECISION, LINE, LINE_BEGUN
from mtr_operator.domain.results.notebook import Notebook
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.storage.journal.journal_file import read_journal
from mtr_operator.storage.progress_file import load_progress, open_progress
from mtr_operator.storage.store import Store

PARAMETERS = KeyPressParameters().to_mapping()
RESULT = {"radial": 1, "angle_deg": 0.0, "status": "ok", "distance_m": 5.0, "failed_distance_m": None,
          "uncertainty_m": 0.03, "attempts": 3, "robot_time_s": 12.345678, "reason": ""}


@pytest.fixture
def second(tmp_path, monkeypatch):
    """The second place."""
    folder = tmp_path / "second"
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setattr("mtr_operator.storage.journal.second_place.second_places",
                        lambda: (tmp_path / "file" / "no", folder))
    return folder


@pytest.fixture
def progress():
    return Progress("key_press", dict(PARAMETERS), {}, CarDimensions(4.5, 1.8, 0.02, 0.01))


def loaded(path):
    return load_progress(path, SCENARIOS["key_press"], PARAMETERS)


def measure(store, progress, *numbers):
    """Lines; what is said of those that are kept elsewhere."""
    notebook, said = Notebook(progress, KeyPressResult, store), []
    for number in numbers:
        for entry in ((LINE_BEGUN, {"line": number}), (LINE, {"result": {**RESULT, "radial": number}, "frame": None})):
            try:
                notebook.add(*entry)
            except OutputError as error:
                said.append(str(error))
    return said


def full_disk(monkeypatch, folder):
    """No byte more for files in this folder."""
    write = os.write

    def refuse(descriptor, data):
        if os.readlink(f"/proc/self/fd/{descriptor}").startswith(str(folder)):
            write(descriptor, bytes(data[:10]))
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write(descriptor, data)
    monkeypatch.setattr("os.write", refuse)


@pytest.mark.parametrize("trouble", ["full disk", "folder gone", "file replaced"])
def test_line_is_kept_in_the_second_place_and_the_test_goes_on_from_there(tmp_path, second, progress, monkeypatch,
                                                                          trouble):
    path = tmp_path / "out" / "progress.json"
    path.parent.mkdir()
    with Store(path, progress) as store:
        notebook = Notebook(progress, KeyPressResult, store)
        notebook.add(LINE_BEGUN, {"line": 1})
        before = (path.parent / "progress.journal").read_bytes()
        if trouble == "full disk":
            full_disk(monkeypatch, path.parent)
        elif trouble == "folder gone":
            shutil.rmtree(path.parent)
        else:
            (path.parent / "progress.journal").unlink()
        with pytest.raises(OutputError, match="What was measured is kept in ") as caught:
            notebook.add(LINE, {"result": RESULT, "frame": None})
        # What comes after that goes there too, without another word.
        notebook.add(DECISION, {"action": "the robot stands still"})
    kept, = second.iterdir()
    assert str(kept) in str(caught.value)
    assert progress.measured() == [1]
    assert loaded(kept).measured() == [1]
    if trouble == "full disk":
        assert (path.parent / "progress.journal").read_bytes() == before


def test_no_second_place_either_is_said(tmp_path, progress, monkeypatch):
    monkeypatch.setattr("mtr_operator.storage.journal.second_place.second_places", lambda: ())
    with Store(tmp_path / "progress.json", progress) as store:
        full_disk(monkeypatch, tmp_path)
        with pytest.raises(OutputError, match="No second place could be written either"):
            store.add(LINE, {"result": RESULT, "frame": None})


def test_what_was_kept_stays_when_the_second_place_fails_too(tmp_path, second, progress, monkeypatch):
    path = tmp_path / "out" / "progress.json"
    path.parent.mkdir()
    with Store(path, progress) as store:
        measure(store, progress, 1, 2, 3)
        shutil.rmtree(path.parent)
        assert "is kept in" in measure(store, progress, 4)[0]
        kept, = second.iterdir()
        with monkeypatch.context() as full:
            full_disk(full, second)
            assert "No second place could be written either" in measure(store, progress, 5)[0]
            assert list(second.iterdir()) == [kept] and loaded(kept).measured() == [1, 2, 3, 4]
        # There is room again: all goes into a file of its own, and whoever names the former one gets all, too.
        assert "is kept in" in measure(store, progress, 6)[0]
    assert len(list(second.iterdir())) == 2
    assert read_journal(kept).entries[-1].values["result"]["radial"] == 4
    assert loaded(kept).measured() == [1, 2, 3, 4, 5, 6]


@pytest.mark.parametrize("named", ["progress.json", "progress.journal", "in the second place"])
def test_test_that_goes_on_takes_what_was_kept_and_has_its_journal_whole_again(tmp_path, second, progress, monkeypatch,
                                                                               named):
    path = tmp_path / "out" / "progress.json"
    path.parent.mkdir()
    with Store(path, progress) as store:
        measure(store, progress, 1, 2)
        store.save()
        with monkeypatch.context() as full:
            full_disk(full, path.parent)
            measure(store, progress, 3, 4)
    kept, = second.iterdir()
    before = kept.read_bytes()
    progress = loaded(kept if named == "in the second place" else path.with_name(named))
    assert progress.measured() == [1, 2, 3, 4]
    assert (f"is taken from {kept}" in progress.notice) == (named != "in the second place")
    # Who only looks at it sees what is there.
    assert open_progress(path, SCENARIOS)[2].measured() == [1, 2]
    with Store(path, progress) as store:
        measure(store, progress, 5)
        with monkeypatch.context() as full:
            full_disk(full, path.parent)
            measure(store, progress, 6)
    assert kept.read_bytes() == before
    entries = read_journal(path.with_suffix(".journal")).entries
    assert [entry.values["result"]["radial"] for entry in entries if entry.kind == LINE] == [1, 2, 3, 4, 5]
    assert [entry.sequence for entry in entries] == list(range(1, len(entries) + 1))
    assert loaded(path).measured() == [1, 2, 3, 4, 5, 6]


def test_part_that_was_measured_apart_is_not_joined_and_is_named(tmp_path, second, progress, monkeypatch):
    path = tmp_path / "out" / "progress.json"
    path.parent.mkdir()
    with Store(path, progress) as store:
        measure(store, progress, 1)
        with monkeypatch.context() as full:
            full_disk(full, path.parent)
            measure(store, progress, 2, 3)
    kept, = second.iterdir()
    aside = kept.rename(tmp_path / kept.name)
    progress = loaded(path)
    with Store(path, progress) as store:
        measure(store, progress, 4)
    aside.rename(kept)
    progress = loaded(path)
    assert progress.measured() == [1, 4]
    assert progress.notice.endswith(f"Another part of this test, measured apart from this one, is kept in {kept}.")


@pytest.fixture
def fakes(monkeypatch, robot_link, car_link):
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    return robot_link


def test_command_line_says_where_a_line_was_kept_when_its_folder_has_gone(tmp_path, second, world, fakes, capsys):
    parameters, out = tmp_path / "parameters.yaml", tmp_path / "out"
    parameters.write_text("measurements_distance_m: 10.0\n", encoding="utf-8")

    def lose(status):
        if status.id == 200:
            shutil.rmtree(out)
        return status
    world.spoil = lose
    command = ["run", "autolock", "--params", str(parameters), "--out"]
    assert main([*command, str(out)]) == 2
    said = capsys.readouterr().err
    kept, = second.iterdir()
    assert f"What was measured is kept in {kept}, with which the test can be continued." in said
    assert fakes.answers[-1][1].stop
    world.spoil = lambda status: status
    assert main([*command, str(tmp_path / "again"), "--continue", str(kept)]) == 0
    assert "8 lines measured" in capsys.readouterr().out
