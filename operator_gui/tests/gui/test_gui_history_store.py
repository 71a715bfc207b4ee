"""Tests of the laboratory's store in the window: listed beside those of the folders, continued, repeated, compared."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import sys
from importlib.metadata import EntryPoint
from types import SimpleNamespace

import pytest
from earlier_tests import opened, shown_history
from PyQt5.QtCore import Qt

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.gui.history.comparison_window import ComparisonWindow
from mtr_operator.history import laboratory
from mtr_operator.history.reading import read_entry


class KeptElsewhere:
    """A store with the tests of a folder."""

    where = "/store/tests"

    def __init__(self, paths):
        self.paths = paths

    def entries(self):
        return [dataclasses.replace(read_entry(path), path=str(number), parameters="", store=self.where)
                for number, path in enumerate(self.paths)]

    def fetch(self, entry, path):
        path.write_bytes(self.paths[int(entry.path)].read_bytes())


@pytest.fixture
def store(lab, monkeypatch):
    """A store that has the lab's test of another car, and half a test, which are in no folder of the lab."""
    folder = lab.application.flow.store.settings.progress_folder
    elsewhere = folder.parent / "elsewhere"
    elsewhere.mkdir()
    kept = KeptElsewhere([(folder / f"{number}.json").rename(elsewhere / f"{number}.json") for number in (1, 2)])
    point = EntryPoint("store", "kept_elsewhere:opened", laboratory.GROUP)
    monkeypatch.setitem(sys.modules, "kept_elsewhere", SimpleNamespace(opened=lambda: kept))
    monkeypatch.setattr(laboratory, "_installed", lambda: [point])
    return kept


def test_tests_of_the_store_are_listed_beside_those_of_the_folders_and_told(lab, store):
    history = shown_history(lab)
    said = history.notice.text().replace("\u200b", "")
    assert "3 tests, 3 of them shown. In the store /store/tests alone: 2;" in said
    model = history.table.model()
    assert model.data(model.index(2, 0), Qt.ToolTipRole) == "In the store /store/tests, as test 0"


def test_half_a_test_of_the_store_is_copied_to_be_continued(lab, store):
    history = shown_history(lab)
    folder = lab.application.flow.store.settings.progress_folder
    before = set(folder.iterdir())
    history.table.selectRow(1)
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.measurement and lab.model.done == 2)
    copy, = set(folder.iterdir()) - before
    assert lab.model.current_test.path == copy and copy.name.startswith("key_press_2020-01-02_10-00-00")


def test_test_of_the_store_is_repeated_and_compared(lab, store):
    history = shown_history(lab)
    history.search.setText("2020-01")
    history.table.selectAll()
    lab.click(history.compare)
    assert len(opened(lab, ComparisonWindow).comparison.distances) == 2
    history.search.setText("other")
    history.table.selectRow(0)
    lab.click(history.repeat)
    lab.wait(lambda: lab.window.screen is lab.window.settings["key_press"])
    assert lab.window.settings["key_press"].identity.fields["car_vin"].text == "OTHER"


def test_store_that_is_away_is_said_and_hides_no_test_of_the_folders(lab, monkeypatch):
    def away():
        raise ProgressFileError("The store /store/tests is away: no database server answers there.")
    monkeypatch.setitem(sys.modules, "kept_elsewhere", SimpleNamespace(opened=away))
    monkeypatch.setattr(laboratory, "_installed",
                        lambda: [EntryPoint("store", "kept_elsewhere:opened", laboratory.GROUP)])
    history = shown_history(lab)
    assert "is away" in history.notice.text() and history.table.model().rowCount() == 4
