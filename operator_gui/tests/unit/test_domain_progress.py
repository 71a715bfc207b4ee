"""Progress files: round trip, and a sentence for every file that does not fit."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import csv
import dataclasses
import json
import math
import os
import pathlib
import resource

import pytest

from mtr_operator.domain.errors import OutputError, ProgressFileError
from mtr_operator.domain.results.document import read_record
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.report.results_csv import results_csv
from mtr_operator.storage.atomic import output_folder, write_bytes
from mtr_operator.storage.progress_file import load_progress, open_progress, refuse_to_overwrite, save_progress

SCENARIO = SCENARIOS["key_press"]
PARAMETERS = KeyPressParameters().to_mapping()
# Files of a demo with version 0.1.0.
WRITTEN_BEFORE = pathlib.Path(__file__).parent / "written_before"


def result(number, status="ok"):
    return {"radial": number, "angle_deg": 45.0, "status": status, "distance_m": 5.0, "failed_distance_m": None,
            "uncertainty_m": 0.03, "attempts": 3, "robot_time_s": 12.345678, "reason": ""}


@pytest.fixture
def progress():
    return Progress("key_press", dict(PARAMETERS), {"started": "today"}, CarDimensions(4.5, 1.8, 0.02, 0.01),
                    [read_record(KeyPressResult, result(number)) for number in (1, 2)], [2])


@pytest.fixture
def path(tmp_path, progress):
    path = tmp_path / "progress.json"
    save_progress(path, progress)
    return path


def test_round_trip(path, progress):
    assert load_progress(path, SCENARIO, PARAMETERS) == progress


@pytest.mark.parametrize("name", ["autolock", "key_press"])
def test_files_of_version_0_1_are_read_and_written_again_with_nothing_changed(tmp_path, name):
    scenario, _, progress = open_progress(WRITTEN_BEFORE / name / "progress.json", SCENARIOS)
    save_progress(tmp_path / "progress.json", progress)
    before, after = (json.loads((folder / "progress.json").read_text(encoding="utf-8"))
                     for folder in (WRITTEN_BEFORE / name, tmp_path))
    assert {**after, "parameters": before["parameters"]} == before
    assert before["parameters"].items() <= after["parameters"].items()
    # Columns that came later change neither the former ones nor their order.
    lines = results_csv(scenario, progress).splitlines()
    former = (WRITTEN_BEFORE / name / "results.csv").read_text(encoding="utf-8").splitlines()
    assert [line for line in former if line.startswith("#") and line not in lines] == []
    (names, *table), (new_names, *rows) = (
        list(csv.reader(line for line in each if not line.startswith("#"))) for each in (former, lines))
    places = [new_names.index(column) for column in names]
    assert places == sorted(places)
    assert [[row[place] for place in places] for row in rows] == table


def test_only_the_file_itself_is_left(path):
    assert [file.name for file in path.parent.iterdir()] == ["progress.json"]


def test_file_names_its_format_and_version(path):
    document = json.loads(path.read_text(encoding="utf-8"))
    assert (document["format"], document["version"]) == ("mtr-operator progress", 1)


def edited(path, **changes):
    document = json.loads(path.read_text(encoding="utf-8"))
    document.update(changes)
    path.write_text(json.dumps(document), encoding="utf-8")


@pytest.mark.parametrize(("changes", "part"), [
    ({"format": "something else"}, "not a progress file"),
    ({"version": 2}, "version 2; this application reads version 1"),
    ({"version": "a" * 5000}, f"version {60 * 'a'}; this application reads version 1"),
    ({"scenario": "a" * 5000}, f"belongs to the scenario {60 * 'a'}, not to"),
    ({"scenario": "autolock"}, "belongs to the scenario autolock, not to key_press"),
    ({"parameters": {**PARAMETERS, "attempts": 4}}, "other parameters: attempts was 4, now it is 1"),
    ({"parameters": None}, "damaged"),
    ({"results": None}, "damaged"),
    ({"results": [{"radial": 1}]}, "damaged"),
    ({"results": [7]}, "damaged"),
    ({"results": [result(1), result(1)]}, "damaged"),
    ({"results": [result("1")]}, "damaged"),
    ({"results": {"a": 1}}, "damaged"),
    ({"results": [{**result(1), "distance_m": "far"}]}, "damaged"),
    ({"results": [{**result(1), "distance_m": None}]}, "damaged"),
    ({"results": [{**result(1), "status": "fine"}]}, "damaged"),
    ({"results": [{**result(1), "reason": None}]}, "damaged"),
    ({"results": [{**result(1), "attempts": True}]}, "damaged"),
    ({"results": [{**result(1), "angle_deg": None}]}, "damaged"),
    ({"retried": 3}, "damaged"),
    ({"car": None}, "damaged"),
    ({"car": {"length": 4.5}}, "damaged"),
    ({"car": {"length": "x", "width": 1, "length_sigma": 0, "width_sigma": 0}}, "damaged"),
    ({"retried": [None]}, "damaged"),
    ({"session": 3}, "damaged"),
])
def test_file_that_does_not_fit_is_a_sentence(path, changes, part):
    edited(path, **changes)
    with pytest.raises(ProgressFileError) as caught:
        load_progress(path, SCENARIO, PARAMETERS)
    assert part in str(caught.value)
    assert str(path) in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"[]", b"null", b"{", b"\xff\xfe", b"[" * 100000, b'{"a": NaN}',
                                     b"radial,angle_deg\n1,0\n"])
def test_foreign_content_is_a_sentence(path, content):
    path.write_bytes(content)
    with pytest.raises(ProgressFileError, match="truncated or not a JSON file|not a progress file"):
        load_progress(path, SCENARIO, PARAMETERS)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.9, 0.99])
def test_truncated_file_is_a_sentence(path, part):
    content = path.read_bytes()
    path.write_bytes(content[:int(part * len(content))])
    with pytest.raises(ProgressFileError, match="truncated"):
        load_progress(path, SCENARIO, PARAMETERS)


def test_missing_file_is_a_sentence(tmp_path):
    with pytest.raises(ProgressFileError, match="cannot be read"):
        load_progress(tmp_path / "none.json", SCENARIO, PARAMETERS)


def test_another_car_is_a_sentence(progress):
    progress.check_car(CarDimensions(4.42, 1.86, 0.02, 0.02))
    with pytest.raises(ProgressFileError, match=r"length was 4\.50 m, now it measures 4\.20 m"):
        progress.check_car(CarDimensions(4.2, 1.8, 0.02, 0.02))


@pytest.mark.parametrize(("sigma_m", "apart_m", "is_other"), [
    # Sure of both sizes: 14 cm are another Car, and what two mappings of one differ by is none.
    (0.005, 0.14, True), (0.005, 0.02, False), (0.0, 0.019, False), (0.0, 0.021, True),
    # Unsure, or as sure as nobody knows.
    (0.05, 0.14, False), (0.05, 0.16, True), (0.87, 0.16, True), (math.nan, 0.14, False), (math.nan, 0.16, True)])
def test_car_mapped_anew_is_the_same_within_its_own_sigmas(progress, sigma_m, apart_m, is_other):
    progress.car = CarDimensions(4.5, 1.8, sigma_m, sigma_m)
    for length, width in ((4.5 - apart_m, 1.8), (4.5, 1.8 + apart_m)):
        with pytest.raises(ProgressFileError, match="another Car") if is_other else contextlib.nullcontext():
            progress.check_car(CarDimensions(length, width, sigma_m, sigma_m))


def test_measured_lines_are_not_overwritten(path):
    with pytest.raises(OutputError, match="holds results of another test"):
        refuse_to_overwrite(path)


def test_reports_without_their_progress_file_are_not_overwritten(tmp_path):
    (tmp_path / "results.csv").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match=r"holds results\.csv of another test"):
        refuse_to_overwrite(tmp_path / "progress.json", ["results.csv"])


def is_refused(path):
    try:
        refuse_to_overwrite(path)
    except OutputError:
        return True
    return False


def test_file_without_lines_may_be_overwritten(path, tmp_path):
    assert is_refused(path)
    edited(path, results=[])
    assert not is_refused(path) and not is_refused(tmp_path / "none.json")


def test_interrupted_write_leaves_the_former_file(path, monkeypatch, progress):
    before = path.read_bytes()

    def fail(*_):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr("os.replace", fail)
    with pytest.raises(OutputError, match="No space left"):
        save_progress(path, progress)
    assert path.read_bytes() == before
    assert len(list(path.parent.iterdir())) == 1


def test_folder_that_cannot_be_written_is_a_sentence(tmp_path):
    file = tmp_path / "file"
    file.write_text("x", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be written to the folder"), output_folder(file / "folder"):
        pass
    with pytest.raises(OutputError, match="cannot be written"):
        write_bytes(file / "results.csv", b"")


def test_folder_is_made_with_its_parents_and_goes_when_nothing_is_left_in_it(tmp_path):
    with pytest.raises(RuntimeError), output_folder(tmp_path / "a" / "b"):
        assert (tmp_path / "a" / "b").is_dir()
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []


def test_folder_stays_when_something_is_in_it_or_it_was_there(tmp_path):
    with pytest.raises(RuntimeError), output_folder(tmp_path / "a" / "b"):
        (tmp_path / "a" / "progress.json").write_text("", encoding="utf-8")
        raise RuntimeError
    assert [path.name for path in tmp_path.rglob("*")] == ["a", "progress.json"]


def test_interrupted_write_leaves_no_part_of_a_file(path, monkeypatch, progress):
    def interrupt(*_):
        raise KeyboardInterrupt
    monkeypatch.setattr("os.replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        save_progress(path, progress)
    assert len(list(path.parent.iterdir())) == 1


def test_numbers_that_are_none_are_refused_by_the_file_format(tmp_path, progress):
    progress.results[0] = dataclasses.replace(progress.results[0], distance_m=float("nan"))
    with pytest.raises(ValueError, match="JSON"):
        save_progress(tmp_path / "progress.json", progress)


def test_disk_without_room_is_a_sentence_before_the_robot_moves(tmp_path):  # C4
    former = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, former[1]))
    try:
        with pytest.raises(OutputError, match="cannot be written to the folder"), output_folder(tmp_path / "out"):
            pass
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, former)
    assert list(tmp_path.iterdir()) == []


def test_file_that_another_program_holds_is_replaced_when_it_lets_go(tmp_path, monkeypatch):  # C7
    replace, refusals = os.replace, [1, 1, 1]

    def refuse(source, target):
        if refusals:
            refusals.pop()
            raise PermissionError(13, "Permission denied")
        replace(source, target)
    monkeypatch.setattr("os.replace", refuse)
    monkeypatch.setattr("time.sleep", lambda duration_s: None)
    write_bytes(tmp_path / "progress.json", b"new")
    assert (tmp_path / "progress.json").read_bytes() == b"new"
