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
from mtr_operator.storage.progress_file import load_progress
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
    assert load_progress(kept, SCENARIOS["key_press"], PARAMETERS).measured() == [1]
    if trouble == "full disk":
        assert (path.parent / "progress.journal").read_bytes() == before


def test_no_second_place_either_is_said(tmp_path, progress, monkeypatch):
    monkeypatch.setattr("mtr_operator.storage.journal.second_place.second_places", lambda: ())
    with Store(tmp_path / "progress.json", progress) as store:
        full_disk(monkeypatch, tmp_path)
        with pytest.raises(OutputError, match="No second place could be written either"):
            store.add(LINE, {"result": RESULT, "frame": None})


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
