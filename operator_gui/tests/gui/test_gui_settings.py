"""The settings window."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.gui.theme.palette import DARK, LIGHT
from mtr_operator.gui.windows.settings_window import SettingsWindow


@pytest.fixture
def window(operator, qtbot):
    made = SettingsWindow(operator.application.flow, operator.application.appearance)
    qtbot.addWidget(made)
    made.show()
    return made


def test_connection_is_shown_and_cannot_be_edited(window):
    fields = (window.host, window.subscriber_port, window.publisher_port)
    assert [field.text for field in fields] == ["127.0.0.1", "3334", "3333"]
    assert all(field.edit.isReadOnly() for field in fields)


def test_folders_are_chosen_and_remembered(window, operator, start, monkeypatch):
    chosen = iter((operator.folder / "a", operator.folder / "b"))
    monkeypatch.setattr("mtr_operator.gui.windows.settings_window.ask_folder", lambda *_: next(chosen))
    window.choose_results()
    window.choose_progress()
    assert window.results.text == str(operator.folder / "a")
    settings = start().flow.store.settings
    assert (settings.result_folder, settings.progress_folder) == (operator.folder / "a", operator.folder / "b")


def test_theme_changes_at_once_and_is_remembered(window, operator, start):
    window.theme.setCurrentIndex(window.theme.findData("dark"))
    assert operator.application.appearance.palette is DARK
    assert start().appearance.palette is DARK
    window.theme.setCurrentIndex(window.theme.findData("light"))
    assert operator.application.appearance.palette is LIGHT


def test_language_is_remembered(window, operator):
    window.language.setCurrentIndex(window.language.findData("cs"))
    assert operator.application.flow.store.settings.language == "cs"
    assert "started next" in window.message.text()


def test_can_adapter_can_be_changed_without_a_restart(window, operator, opener):
    window.can.interface.setCurrentIndex(0)
    operator.click(window.use_can)
    operator.wait(lambda: "No CAN adapter" in operator.window.header.status.toolTip())
    window.can.interface.setCurrentIndex(window.can.interface.findData("simulated"))
    operator.click(window.use_can)
    operator.wait(lambda: "Ready" in operator.window.header.status.text())
    opener.car_refusal = "There is no CAN adapter at /dev/ttyACM0; check the channel and the USB plug."
    operator.click(window.use_can)
    operator.wait(lambda: window.message.text() == opener.car_refusal)


def test_damaged_settings_are_told_and_do_not_hinder_the_start(start, settings_path):
    settings_path.write_text("{", encoding="utf-8")
    assert "were not used" in start().window.message.text()
