"""The tests of before in the window: listed, searched, opened, continued, repeated, compared."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import sys
import threading
from importlib.metadata import EntryPoint
from types import SimpleNamespace

import pytest
from PyQt5.QtCore import Qt

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.progress import JournalMark
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.history import history_screen
from mtr_operator.gui.history.comparison_window import ComparisonWindow
from mtr_operator.gui.history.history_model import HistoryModel
from mtr_operator.gui.history.replay_window import ReplayWindow
from mtr_operator.gui.history.spread_window import SpreadWindow
from mtr_operator.gui.i18n import Language
from mtr_operator.gui.waited_thread import WaitedThread
from mtr_operator.history import laboratory
from mtr_operator.history.reading import read_entry
from mtr_operator.replay import replay_file
from mtr_operator.replay.replay import ReplayedTest
from mtr_operator.storage.progress_file import open_progress, save_progress


@pytest.fixture
def lab(operator):
    """An operator with three tests: one measured now, one of another car, and the half of one."""
    operator.begin("key_press")
    operator.click(operator.finish().done)
    folder = operator.application.flow.store.settings.progress_folder
    [record] = folder.glob("*.json")
    progress = operator.application.flow.open(record) or operator.model.current_test.progress
    operator.application.flow.to_welcome()
    for number, (vin, results) in enumerate((("OTHER", progress.results), ("", progress.results[:2])), start=1):
        session = {**progress.session, "started": f"2020-01-0{number}T10:00:00+01:00"}
        save_progress(folder / f"{number}.json", dataclasses.replace(
            progress, session=session, results=list(results), kept=JournalMark(str(number), 5), frame_record=type(
                progress.frame_record)(), identity=Identity(vin) if vin else None))
    return operator


def show(operator, count=3):
    """The history, when it is read."""
    history = operator.window.history
    operator.click(operator.window.welcome.open)
    operator.wait(lambda: len(history.shown) == count and "tests" in history.notice.text())
    return history


def test_tests_are_listed_newest_first_and_searched(lab):
    history = show(lab)
    assert [entry.started[:4] for entry in history.shown][1:] == ["2020", "2020"]
    history.search.setText("other")
    assert [entry.car for entry in history.shown] == ["OTHER"]
    history.search.setText("")
    history.filters.car.setCurrentIndex(history.filters.car.findData("OTHER"))
    assert len(history.shown) == 1


def test_finished_test_opens_as_protocol_and_half_a_test_is_continued(lab):
    history = show(lab)
    assert not history.open.isEnabled()
    history.table.selectRow(0)
    assert history.open.text() == "Open"
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.protocol)
    lab.click(lab.window.protocol.done)
    history = show(lab)
    history.table.selectRow(1)
    assert history.open.text() == "Continue"
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.measurement and lab.model.done == 2)


def test_test_is_repeated_with_its_parameters_and_its_car(lab):
    history = show(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    lab.click(history.repeat)
    screen = lab.window.settings["key_press"]
    lab.wait(lambda: lab.window.screen is screen)
    assert screen.form.fields["angle_between_radials_rad"].text == "90"
    assert screen.identity.fields["car_vin"].text == "OTHER"


def test_two_tests_are_compared_with_stop_in_sight(lab):
    history = show(lab)
    history.table.selectAll()
    assert not history.compare.isEnabled() and not history.repeat.isEnabled()
    history.search.setText("2020-01")
    history.table.selectAll()
    lab.click(history.compare)
    window = opened(lab, ComparisonWindow)
    assert window.isVisible() and window.findChildren(StopButton) and not window.isModal()
    model = window.table.model()
    assert model.rowCount() == 2
    # The oldest is the first; the same figures show no difference.
    assert model.data(model.index(0, 3)) == "+0.00"
    assert model.data(model.index(0, 2)) in ("no difference shown", "not known")
    window.table.selectRow(1)
    assert "Car's VIN: OTHER / \N{EN DASH}" in window.summary.text()
    window.close()
    language = Language()
    language.use("cs")
    try:
        said = ComparisonWindow(window.comparison, lab.application.appearance).summary.text()
    finally:
        language.use("en")
    assert "2kr\u00e1t " in said


def opened(lab, kind):
    """The window that comes when a thread has done its work."""
    lab.wait(lambda: lab.window.findChildren(kind))
    [window] = lab.window.findChildren(kind)
    return window


def test_spread_of_chosen_tests_is_shown_with_stop_in_sight(lab):
    history = show(lab)
    assert not history.spread.isEnabled()
    history.table.selectAll()
    lab.click(history.spread)
    window = opened(lab, SpreadWindow)
    assert window.isVisible() and window.findChildren(StopButton) and not window.isModal()
    assert history.spread.isEnabled()
    model = window.table.model()
    # Three tests have the first two lines, two the others; the results are copies of each other.
    assert [model.data(model.index(row, 2)) for row in range(4)] == ["3", "3", "2 of 3", "2 of 3"]
    values = [result.distances[0].distance_m for result in open_progress(history.chosen[0].file, SCENARIOS)[2].results]
    assert model.data(model.index(0, 3)) == f"{values[0]:.2f}"
    assert model.data(model.index(0, 5)) == "< 0.001"
    assert model.data(model.index(0, 7)) == f"{values[0]:.2f} to {values[0]:.2f}"
    assert "All tests have the same value" in model.data(model.index(0, 0), Qt.ItemDataRole.ToolTipRole)
    assert "3 tests from 2020-01-01" in window.summary.text() and "Car's VIN" in window.summary.text()
    window.table.selectRow(2)
    assert len(window._points.chosen) == 2
    window.close()


def test_spread_of_one_test_takes_all_of_its_car_and_key_with_its_parameters(lab):
    history = show(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    lab.click(history.spread)
    assert "No other test has the parameters" in history.notice.text()
    # The two of which nobody said whose car it was, one of them complete.
    history.search.setText("2020-01-02")
    history.table.selectRow(0)
    history.spread.setFocus()
    # Filters do not hide repetitions.
    lab.bot.keyClick(history.spread, Qt.Key_Return)
    window = opened(lab, SpreadWindow)
    model = window.table.model()
    assert [model.data(model.index(row, 2)) for row in range(model.rowCount())] == ["2", "2"]
    assert len(window.found.tests.sides) == 2 and not window.found.differing


def test_file_that_is_broken_meanwhile_is_said_and_the_spread_can_be_wanted_again(lab):
    history = show(lab)
    history.table.selectAll()
    # Without a journal that knows all of it.
    history.shown[2].file.write_bytes(b"{")
    lab.click(history.spread)
    lab.wait(lambda: "truncated or not a JSON file" in history.notice.text())
    assert history.spread.isEnabled() and not lab.window.findChildren(SpreadWindow)


def test_broken_record_is_a_row_with_its_sentence_and_nothing_can_be_done_with_it(lab):
    folder = lab.application.flow.store.settings.progress_folder
    (folder / "broken.json").write_bytes(b"{")
    history = show(lab)
    lab.wait(lambda: "broken.json" in history.notice.text())
    summary = history.notice.text()
    assert summary.startswith("3 tests, 3 of them shown.")
    model = history.table.model()
    assert model.rowCount() == 4
    texts = [model.data(model.index(3, column)) for column in range(model.columnCount())]
    assert "cannot be read" in texts and "broken.json" in texts
    history.table.selectRow(3)
    assert "truncated or not a JSON file" in history.notice.text()
    assert not history.open.isEnabled() and not history.repeat.isEnabled()
    history.table.doubleClicked.emit(model.index(3, 0))
    assert lab.window.screen is history
    history.table.selectRow(0)
    assert history.open.isEnabled() and history.notice.text() == summary
    history.search.setText("truncated")
    assert model.rowCount() == 1
    history.search.setText("")
    history.filters.car.setCurrentIndex(history.filters.car.findData("OTHER"))
    assert model.rowCount() == 1


def test_test_in_a_bundle_is_listed_repeated_and_not_opened(lab):
    flow = lab.application.flow
    folder = flow.store.settings.progress_folder
    record = folder / "1.json"
    scenario, _, progress = open_progress(record, SCENARIOS)
    write_bundle(folder / "1.mtr.zip", record, scenario, progress, None, station=Station(folder.parent / "station"))
    record.unlink()
    history = show(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    assert not history.open.isEnabled() and "signed bundle" in history.notice.text()
    lab.click(history.repeat)
    lab.wait(lambda: lab.window.screen is lab.window.settings["key_press"])


def test_test_of_a_scenario_that_this_version_does_not_know_is_shown_by_its_name(lab):
    history = show(lab)
    history._learn_all([dataclasses.replace(history.shown[0], scenario="teleport")])
    assert history.table.model().data(history.table.model().index(0, 1)) == "teleport"


def test_file_that_changes_between_list_and_click_is_said(lab):
    history = show(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    history.shown[0].file.write_bytes(b"{")
    lab.click(history.repeat)
    lab.wait(lambda: "truncated or not a JSON file" in history.notice.text())
    assert history.repeat.isEnabled() and lab.window.screen is history


def test_choice_stays_while_more_tests_are_found(lab):
    history = show(lab)
    history.table.selectRow(1)
    chosen = history.chosen
    history._learn(list(history._entries))
    assert history.chosen == chosen and history.open.isEnabled()


def test_ten_thousand_tests_with_a_broken_one_are_found_and_only_those_in_sight_are_painted(lab, monkeypatch):
    history = show(lab)
    entry, asked = history.shown[0], []
    entries = [dataclasses.replace(entry, path=f"{number}.json", car=f"VIN{number}") for number in range(10_000)]
    entries.append(dataclasses.replace(entry, path="broken.json", problem="The test in broken.json is damaged."))
    data = HistoryModel.data
    monkeypatch.setattr(HistoryModel, "data", lambda *args: asked.append(1) or data(*args))
    history._learn_all(entries)
    history.table.repaint()
    assert len(history.shown) == 10_000
    assert "10000 tests, 10000 of them shown." in history.notice.text() and "broken.json" in history.notice.text()
    # A screen of rows with a few roles each, and not a hundred thousand cells.
    assert 0 < len(asked) < 10_000
    history.filters.car.setCurrentIndex(history.filters.car.findData("VIN9999"))
    assert [each.car for each in history.shown] == ["VIN9999"]


def test_choice_of_ten_thousand_is_kept_at_once_while_the_list_grows(lab, monkeypatch):
    history = show(lab)
    entry = history.shown[0]
    entries = [dataclasses.replace(entry, path=f"{number}.json", test_id=str(number)) for number in range(10_000)]
    history._learn(entries[:-1])
    history.table.selectAll()
    looks = []
    show_choice = history._show_choice
    monkeypatch.setattr(history, "_show_choice", lambda: looks.append(1) or show_choice())
    history._learn(entries)
    # Each look is at all that is chosen.
    assert len(history.chosen) == 9_999 and len(looks) < 10


def test_test_without_a_profile_that_can_be_read_says_so_when_it_is_computed_anew(lab):
    history = show(lab)
    assert not history.anew.isEnabled()
    history.table.selectRow(0)
    lab.click(history.anew)
    lab.wait(history.anew.isEnabled)
    assert "profile" in history.notice.text() and not lab.window.findChildren(ReplayWindow)


def test_what_would_change_is_shown_in_a_window_that_leaves_the_stop_alive(lab, monkeypatch):
    history = show(lab)
    history.table.selectRow(0)
    recorded = open_progress(history.chosen[0].file, SCENARIOS)[2].results
    last, name = recorded[-1], "d50_m" if recorded[-1].method == "adaptive" else "distance_m"
    now = [*recorded[:-1], dataclasses.replace(last, **{name: last.distances[0].distance_m + 0.01})]
    found = ReplayedTest(recorded, now, {}, ("Of 2 lines nothing was recorded (3, 4).",))
    monkeypatch.setattr(replay_file, "replay_file", lambda path: (SCENARIOS["key_press"], found))
    lab.click(history.anew)
    lab.wait(lambda: lab.window.findChildren(ReplayWindow))
    [window] = lab.window.findChildren(ReplayWindow)
    assert not window.isModal() and window.findChildren(StopButton)
    model = window.table.model()
    texts = [[model.data(model.index(row, column)) for column in range(5)] for row in range(model.rowCount())]
    assert texts[0][0].startswith(f"{last.number} (")
    assert [row[4] for row in texts] == ["would change"] + [""] * (len(recorded) - 1)
    assert float(texts[0][3]) - float(texts[0][2]) == pytest.approx(0.01)
    for said in (f"1 of {len(recorded)} distances would change", "10.0 mm", "Of 2 lines nothing was recorded"):
        assert said in window.summary.text()
    window.close()


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
    history = show(lab)
    said = history.notice.text().replace("\u200b", "")
    assert "3 tests, 3 of them shown. In the store /store/tests alone: 2;" in said
    model = history.table.model()
    assert model.data(model.index(2, 0), Qt.ToolTipRole) == "In the store /store/tests, as test 0"


def test_half_a_test_of_the_store_is_copied_to_be_continued(lab, store):
    history = show(lab)
    folder = lab.application.flow.store.settings.progress_folder
    before = set(folder.iterdir())
    history.table.selectRow(1)
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.measurement and lab.model.done == 2)
    copy, = set(folder.iterdir()) - before
    assert lab.model.current_test.path == copy and copy.name.startswith("key_press_2020-01-02_10-00-00")


def test_test_of_the_store_is_repeated_and_compared(lab, store):
    history = show(lab)
    history.search.setText("2020-01")
    history.table.selectAll()
    lab.click(history.compare)
    assert opened(lab, ComparisonWindow).table.model().rowCount() == 2
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
    history = show(lab)
    assert "is away" in history.notice.text() and history.table.model().rowCount() == 4


def test_window_made_anew_while_a_test_is_read_hears_nothing_of_it(lab, monkeypatch):
    history = show(lab)
    go_on = threading.Event()
    monkeypatch.setattr(history_screen, "side_of", lambda entry: go_on.wait(10.0))
    history.table.selectRow(0)
    lab.click(history.repeat)
    lab.application.flow.use_language("cs")
    try:
        go_on.set()
        WaitedThread.finish_all()
        lab.wait(lambda: lab.window.history is not history)
    finally:
        lab.application.flow.use_language("en")
