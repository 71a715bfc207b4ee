"""Window, command line and store compare the same two tests with the same result."""
# SPDX-License-Identifier: Apache-2.0
import json

import driven
import measured
import pytest

from mtr_operator.cli import main as operator_main
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.gui.history.comparison_model import ComparisonModel
from mtr_operator.history.chosen import compared
from mtr_operator.history.reading import read_entry
from mtr_operator.storage.progress_file import FILE_NAME, save_progress
from mtr_results.cli import main as store_main

GOLF = Identity(car_model="Golf")


def presses(*borders_m):
    return measured.side(*borders_m, identity=GOLF, mark=str(borders_m))


def events(moved_m):
    """Return a test of the Golf whose axis 13 has moved."""
    def events_m(axis, _word):
        border_m = 1.5 + (moved_m if axis == 13 else 0.0)
        return border_m - 0.1, border_m + 0.05 * (axis % 2)
    made = driven.side(events_m)
    made.progress.session["started"] = f"2026-11-22T10:{round(60.0 * moved_m):02}:00+01:00"
    return made


CASES = {
    # The interval of one line alone excludes zero, and the five quantities together show no difference.
    "different alone": (presses(5.0, 5.0, 5.0, 5.0), presses(5.5, 5.0, 5.0, 5.0)),
    # Only without the outline of the same Car, which both tests have in common, the interval excludes zero.
    "same outline": (events(0.0), events(0.43)),
    "different among all": (presses(5.0, 5.0, 5.0, 5.0), presses(6.5, 5.0, 5.0, 3.9)),
    "almost the same": (presses(5.0, 5.0, 5.0, 5.0), presses(5.0, 5.0, 5.0, 5.01)),
    "one end": (presses(measured.at_least(1, 6.0), 5.0, 5.0, 5.0), presses(5.0, 5.0, 5.0, 5.0)),
    "lines of one test only": (presses(5.0, 5.0, 5.0, 5.0), presses(5.0, 4.0)),
}


def written(folder, sides):
    """Return the files of the tests."""
    files = []
    for number, side in enumerate(sides, start=1):
        files.append(folder / str(number) / FILE_NAME)
        files[-1].parent.mkdir(parents=True)
        save_progress(files[-1], side.progress)
    return files


def of_window(paths):
    model = ComparisonModel(compared(*map(read_entry, paths)))
    return [model.data(model.index(row, 2)) for row in range(model.rowCount())]


def of_command_line(paths, capsys):
    assert operator_main(["compare", *map(str, paths), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def of_store(paths, folder, capsys):
    store, spool = str(folder / "store.sqlite"), str(folder / "spool")
    assert store_main(["import", "--store", store, "--spool", spool, *map(str, paths)]) == 0
    capsys.readouterr()
    assert store_main(["compare", "--store", store, "1", "2", "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def shown(row):
    return row["change"] + (" *" if row["is_different"] else "")


@pytest.mark.parametrize("sides", CASES.values(), ids=CASES)
def test_window_command_line_and_store_have_the_same_result(qapp, sides, tmp_path, capsys):
    paths = written(tmp_path, sides)
    said, found = of_command_line(paths, capsys), of_store(paths, tmp_path, capsys)
    assert of_window(paths) == [shown(row) for row in said["rows"]] == [shown(row) for row in found["rows"]]
    assert {key: said[key] for key in found} == found
    distances = [row for row in found["rows"] if row["quantity"] == "distance"]
    assert [(each["change"], each["low_m"], each["high_m"], each["is_different"]) for each in said["differences"]] == [
        (row["change"], row["low"], row["high"], row["is_different"]) for row in distances]


@pytest.mark.parametrize("name, is_different", [("different alone", False), ("different among all", True)])
def test_difference_of_one_line_alone_is_no_difference_among_all(name, is_different, tmp_path, capsys):
    found = of_command_line(written(tmp_path, CASES[name]), capsys)
    assert found["differences"][0]["change"] == "farther"
    assert found["is_different"] is found["differences"][0]["is_different"] is is_different
    assert found["summary"].startswith("Different among all" if is_different else "No difference is shown")


def test_outline_of_the_same_car_leaves_the_difference_on_the_command_line_too(tmp_path, capsys):
    found = of_command_line(written(tmp_path, CASES["same outline"]), capsys)
    changes = {each["line"]: each["change"] for each in found["differences"]}
    assert changes.pop(13) == "farther" and set(changes.values()) == {"no difference shown"}
