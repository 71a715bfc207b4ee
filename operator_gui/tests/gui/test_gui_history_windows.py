"""Windows of the tests of before: compared, their spread, computed anew; each leaves Stop in sight."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest
from earlier_tests import opened, shown_history
from PyQt5.QtCore import Qt

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.history.comparison_window import ComparisonWindow
from mtr_operator.gui.history.replay_window import ReplayWindow
from mtr_operator.gui.history.spread_window import SpreadWindow
from mtr_operator.gui.i18n import Language
from mtr_operator.replay import replay_file
from mtr_operator.replay.replay import ReplayedTest
from mtr_operator.storage.progress_file import open_progress


def test_two_tests_are_compared_with_stop_in_sight(lab):
    history = shown_history(lab)
    history.table.selectAll()
    assert not history.compare.isEnabled() and not history.repeat.isEnabled()
    history.search.setText("2020-01")
    history.table.selectAll()
    lab.click(history.compare)
    window = opened(lab, ComparisonWindow)
    assert window.isVisible() and window.findChildren(StopButton) and not window.isModal()
    model = window.table.model()
    assert [model.data(model.index(row, 0)) for row in range(2, model.rowCount())] == ["all lines"]
    # The oldest is the first; the same figures show no difference.
    assert model.data(model.index(0, 3)) == "+0.00"
    assert model.data(model.index(0, 2)) in ("no difference shown", "not known")
    assert "No difference is shown among all rows." in window.summary.text()
    window.table.selectRow(2)
    assert len(window._points.chosen) == 4
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


def test_spread_of_chosen_tests_is_shown_with_stop_in_sight(lab):
    history = shown_history(lab)
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
    history = shown_history(lab)
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
    history = shown_history(lab)
    history.table.selectAll()
    # Without a journal that knows all of it.
    history.shown[2].file.write_bytes(b"{")
    lab.click(history.spread)
    lab.wait(lambda: "truncated or not a JSON file" in history.notice.text())
    assert history.spread.isEnabled() and not lab.window.findChildren(SpreadWindow)


def test_test_without_a_profile_that_can_be_read_says_so_when_it_is_computed_anew(lab):
    history = shown_history(lab)
    assert not history.anew.isEnabled()
    history.table.selectRow(0)
    lab.click(history.anew)
    lab.wait(history.anew.isEnabled)
    assert "profile" in history.notice.text() and not lab.window.findChildren(ReplayWindow)


def test_what_would_change_is_shown_in_a_window_that_leaves_the_stop_alive(lab, monkeypatch):
    history = shown_history(lab)
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
