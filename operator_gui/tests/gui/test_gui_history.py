"""The tests of before in the window: listed, searched, opened, continued, repeated."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import threading

from earlier_tests import shown_history
from PyQt5 import sip
from PyQt5.QtCore import QTimer

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.gui.history import history_screen
from mtr_operator.gui.history.history_model import HistoryModel
from mtr_operator.gui.threads.waited_thread import WaitedThread
from mtr_operator.storage.progress_file import open_progress


def test_tests_are_listed_newest_first_and_searched(lab):
    history = shown_history(lab)
    assert [entry.started[:4] for entry in history.shown][1:] == ["2020", "2020"]
    history.search.setText("other")
    assert [entry.car for entry in history.shown] == ["OTHER"]
    history.search.setText("")
    history.filters.car.setCurrentIndex(history.filters.car.findData("OTHER"))
    assert len(history.shown) == 1


def test_finished_test_opens_as_protocol_and_half_a_test_is_continued(lab):
    history = shown_history(lab)
    assert not history.open.isEnabled()
    history.table.selectRow(0)
    assert history.open.text() == "Open"
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.protocol)
    lab.click(lab.window.protocol.done)
    history = shown_history(lab)
    history.table.selectRow(1)
    assert history.open.text() == "Continue"
    lab.click(history.open)
    lab.wait(lambda: lab.window.screen is lab.window.measurement and lab.model.done == 2)


def test_test_is_repeated_with_its_parameters_and_its_car(lab):
    history = shown_history(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    lab.click(history.repeat)
    screen = lab.window.settings["key_press"]
    lab.wait(lambda: lab.window.screen is screen)
    assert screen.form.fields["angle_between_radials_rad"].text == "90"
    assert screen.identity.fields["car_vin"].text == "OTHER"


def test_broken_record_is_a_row_with_its_sentence_and_nothing_can_be_done_with_it(lab):
    folder = lab.application.flow.store.settings.progress_folder
    (folder / "broken.json").write_bytes(b"{")
    history = shown_history(lab)
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
    history = shown_history(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    assert not history.open.isEnabled() and "signed bundle" in history.notice.text()
    lab.click(history.repeat)
    lab.wait(lambda: lab.window.screen is lab.window.settings["key_press"])


def test_test_of_a_scenario_that_this_version_does_not_know_is_shown_by_its_name(lab):
    history = shown_history(lab)
    history._learn_all([dataclasses.replace(history.shown[0], scenario="teleport")])
    assert history.table.model().data(history.table.model().index(0, 1)) == "teleport"


def test_file_that_changes_between_list_and_click_is_said(lab):
    history = shown_history(lab)
    history.search.setText("other")
    history.table.selectRow(0)
    history.shown[0].file.write_bytes(b"{")
    lab.click(history.repeat)
    lab.wait(lambda: "truncated or not a JSON file" in history.notice.text())
    assert history.repeat.isEnabled() and lab.window.screen is history


def test_choice_stays_while_more_tests_are_found(lab):
    history = shown_history(lab)
    history.table.selectRow(1)
    chosen = history.chosen
    history._learn(list(history._entries))
    assert history.chosen == chosen and history.open.isEnabled()


def test_ten_thousand_tests_with_a_broken_one_are_found_and_only_those_in_sight_are_painted(lab, monkeypatch):
    history = shown_history(lab)
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
    history = shown_history(lab)
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


def test_window_made_anew_while_a_test_is_read_hears_nothing_of_it(lab, monkeypatch):
    history = shown_history(lab)
    go_on = threading.Event()
    monkeypatch.setattr(history_screen, "side_of", lambda entry: go_on.wait(10.0))
    history.table.selectRow(0)
    lab.click(history.repeat)
    lab.application.flow.use_language("cs")
    try:
        # What is read before that is offered by the window at hand.
        lab.wait(lambda: lab.window.history is not history)
        lab.wait(lambda: sip.isdeleted(history))
        reading = list(WaitedThread._running)
        go_on.set()
        lab.wait(lambda: all(thread.isFinished() for thread in reading))
    finally:
        go_on.set()
        lab.application.flow.use_language("en")


def test_notice_for_a_window_that_is_no_more_is_no_defect(lab):
    former = lab.window
    lab.application.flow.failed.emit("There is no such folder.")
    lab.application._renew()
    sip.delete(former)
    turns = []
    QTimer.singleShot(0, lambda: turns.append("after it"))
    lab.wait(lambda: turns)
