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
    window.looks.theme.setCurrentIndex(window.looks.theme.findData("dark"))
    assert operator.application.appearance.palette is DARK
    assert start().appearance.palette is DARK
    window.looks.theme.setCurrentIndex(window.looks.theme.findData("light"))
    assert operator.application.appearance.palette is LIGHT


def test_language_changes_at_once_and_is_remembered__B19(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(screen.resume.isEnabled)
    operator.click(operator.window.header.settings)
    settings = operator.window.findChild(SettingsWindow)
    former = operator.window
    settings.looks.language.setCurrentIndex(settings.looks.language.findData("cs"))
    operator.wait(lambda: operator.window is not former)
    assert operator.application.flow.store.settings.language == "cs"
    renewed = operator.window
    assert renewed.isVisible() and not former.isVisible() and renewed.geometry() == former.geometry()
    assert renewed.screen is renewed.measurement
    assert renewed.measurement.resume.text() == "Podr\u017een\u00edm pokra\u010dovat"
    assert renewed.findChild(SettingsWindow).isVisible()
    operator.application.language.use("en")
    operator.click(renewed.measurement.resume)
    operator.finish()


def test_events_after_a_change_of_language_reach_the_new_window_alone__B19(operator, qtbot, monkeypatch):
    said = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message", lambda *words: said.append(words[0]))
    former = operator.window
    operator.application.flow.use_language("en")
    operator.wait(lambda: operator.window is not former)
    qtbot.wait(50)
    with qtbot.capture_exceptions() as caught:
        operator.application.flow.failed.emit("A sentence.")
        operator.application.flow.saved.emit("/tmp/x")
        operator.wait(lambda: said)
        qtbot.wait(50)
    assert (said, caught) == ([operator.window], [])


def test_settings_that_were_opened_while_a_test_ran_take_an_adapter_once_it_rests__B12(operator, window):
    screen = operator.begin()
    operator.wait(lambda: not window.use_can.isEnabled())
    operator.click(operator.window.header.stop)
    operator.wait(screen.resume.isEnabled)
    operator.wait(window.use_can.isEnabled)


def test_adapter_that_was_chosen_and_not_used_is_asked_about__B12(window, operator, monkeypatch):
    answers = []
    monkeypatch.setattr("mtr_operator.gui.windows.settings_window.confirm",
                        lambda *words: answers.append(words[2]) or len(answers) > 1)
    in_use = operator.application.flow.connecting.connection.can
    window.can.interface.setCurrentIndex(0)
    window.close()
    assert not window.isVisible() and operator.application.flow.connecting.connection.can == in_use
    assert answers == ["The CAN adapter that you have chosen is not in use yet. Use it?"]
    window.show()
    window.reject()
    operator.wait(lambda: operator.application.flow.connecting.connection.can is None)
    assert window.isVisible()
    window.reject()
    assert not window.isVisible() and len(answers) == 2


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
