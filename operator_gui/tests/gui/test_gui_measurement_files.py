"""Files of a test in the window: kept, offered, opened again, damaged."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil

import pytest
from stored import stored

from mtr_operator.station.readiness import Phase

LINES = 4


@pytest.fixture
def notice(monkeypatch):
    """Sentences of message boxes."""
    sentences = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message",
                        lambda parent, title, text: sentences.append(text))
    return sentences


def answer_folder(monkeypatch, module, folder):
    monkeypatch.setattr(f"mtr_operator.gui.{module}.ask_folder", lambda parent, title, start: folder)


def test_save_progress_says_where(operator):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(screen.save)
    operator.wait(lambda: "Saved to" in screen.note.text())
    assert str(operator.folder / "progress") in screen.note.text().replace("\N{ZERO WIDTH SPACE}", "")
    assert stored(operator.model.test.path)


def test_vanished_progress_folder_is_asked_for_again_and_nothing_is_lost(operator, monkeypatch, notice):
    other = operator.folder / "other"
    answer_folder(monkeypatch, "windows.main_window", other)
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    folder = operator.folder / "progress"
    shutil.rmtree(folder)
    folder.write_text("a file where the folder was", encoding="utf-8")
    operator.wait(lambda: other.exists() and list(other.glob("*.json")) and operator.model.phase is Phase.PAUSED)
    assert "cannot be written" in notice[0]
    operator.wait(screen.resume.isEnabled)
    operator.click(screen.resume)
    operator.finish()
    assert len(stored(operator.model.test.path)) == LINES
    assert operator.model.test.path.parent == other


def test_folder_that_is_chosen_late_is_of_the_test_that_could_not_be_written(operator, monkeypatch, notice):
    other, asked = operator.folder / "other", []

    def late(*_):
        # The question stands beside the window: the Operator lays the test aside and begins another one first.
        asked.append(operator.model.test)
        operator.click(operator.window.measurement.leave)
        folder = operator.folder / "progress"
        folder.unlink()
        operator.begin()
        operator.wait(lambda: operator.model.done >= 1)
        return other
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_folder", late)
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    folder = operator.folder / "progress"
    shutil.rmtree(folder)
    folder.write_text("a file where the folder was", encoding="utf-8")
    operator.wait(lambda: other.exists() and list(other.glob("*.json")))
    assert [each.stem for each in other.glob("*.json")] == [asked[0].name]
    running = operator.model.test
    assert asked[0].path.parent == other and running.path.parent == folder
    assert operator.application.flow.store.settings.unfinished == running.path
    operator.finish()


def test_closing_asks_first_and_the_next_start_offers_to_go_on(operator, start, monkeypatch, qtbot):
    operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.confirm", lambda *_: False)
    assert not operator.window.close()
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.confirm", lambda *_: True)
    assert operator.window.close()
    operator.application.close()
    measured = len(stored(operator.model.test.path))
    assert measured >= 1

    later = type(operator)(start(), qtbot, operator.folder).connect()
    assert later.window.welcome.offer.isVisible()
    later.application.flow.open(later.application.flow.store.settings.unfinished)
    screen = later.window.measurement
    assert later.window.screen is screen
    assert f"{measured} of {LINES}" in screen.facts.count.text()
    later.wait(screen.resume.isEnabled)
    later.click(screen.resume)
    later.finish()
    assert len(stored(later.model.test.path)) == LINES
    later.click(later.window.protocol.done)
    assert not later.window.welcome.offer.isVisible()


def test_test_of_another_profile_does_not_go_on_and_says_why(operator, notice):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    operator.wait(screen.resume.isEnabled)
    operator.model.test.progress.session["car profile"] = "my_car"
    operator.click(screen.resume)
    operator.wait(lambda: notice)
    assert "begun at a real Car" in notice[0] and operator.model.phase is Phase.PAUSED
    operator.model.test.progress.session["car profile"] = "substitute"
    operator.click(screen.resume)
    operator.finish()


def test_offer_can_be_dismissed_until_the_next_start_and_the_file_stays__B13(operator, start, qtbot):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    operator.click(screen.leave)
    assert operator.window.welcome.offer.isVisible()
    assert operator.window.welcome._first.hasFocus() or not operator.window.isActiveWindow()
    path = operator.application.flow.store.settings.unfinished
    operator.window.welcome.dismiss.emit()
    assert not operator.window.welcome.offer.isVisible()
    assert path.exists()
    operator.application.flow.to_welcome()
    assert not operator.window.welcome.offer.isVisible()
    operator.application.close()
    later = type(operator)(start(), qtbot, operator.folder).connect()
    assert later.window.welcome.offer.isVisible()


def test_finished_test_from_a_file_shows_its_protocol(operator, monkeypatch):
    operator.begin()
    operator.finish()
    path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    assert operator.window.screen is operator.window.protocol
    assert operator.window.protocol.table.model().rowCount() == LINES


@pytest.mark.parametrize(("spoil", "part"), [
    (lambda text: text[:len(text) // 2], "truncated or not a JSON file"),
    (lambda text: "[]", "not a progress file"),
    (lambda text: text.replace('"version": 1', '"version": 99'), "has version 99"),
    (lambda text: text.replace('"maximum_distance_m": 6.5', '"maximum_distance_m": 650.0'), "allowed is 0.1 to 50 m"),
    (lambda text: text.replace('"status": "ok"', '"status": "good"'), "damaged"),
])
def test_bad_progress_file_is_one_sentence_and_changes_nothing(operator, monkeypatch, notice, spoil, part):
    operator.begin()
    operator.finish()
    path: pathlib.Path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    spoilt = spoil(path.read_text(encoding="utf-8"))
    path.write_text(spoilt, encoding="utf-8")
    path.with_suffix(".journal").unlink()
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    operator.wait(lambda: notice)
    assert part in notice[0]
    assert operator.window.screen is operator.window.history
    assert operator.model.test is None
    assert path.read_text(encoding="utf-8") == spoilt


def test_truncated_progress_file_is_recovered_from_its_journal_and_said(operator, monkeypatch, notice):  # C1
    operator.begin()
    operator.finish()
    path: pathlib.Path = operator.model.test.path
    operator.click(operator.window.protocol.done)
    path.write_text(path.read_text(encoding="utf-8")[:1000], encoding="utf-8")
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.ask_progress_file", lambda *_: path)
    operator.click(operator.window.welcome.open)
    operator.click(operator.window.history.file)
    operator.wait(lambda: notice)
    assert "was recovered from its journal" in notice[0]
    assert operator.window.protocol.table.model().rowCount() == LINES


def test_test_that_measured_nothing_leaves_no_file(operator, opener):
    opener.car_problem = ""
    operator.begin()
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    assert not operator.model.results
    assert not list((operator.folder / "progress").glob("*.json"))
    assert operator.application.flow.store.settings.unfinished is None


def test_last_result_is_shown_after_going_on_with_a_file(operator, monkeypatch):
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 2)
    operator.click(operator.window.header.stop)
    operator.wait(lambda: operator.model.phase is Phase.PAUSED)
    path, done = operator.model.test.path, operator.model.done
    operator.click(screen.leave)
    operator.application.flow.open(path)
    assert operator.model.newest.number == done
    assert screen.facts.values["newest"].text().startswith(f"{done} (")
