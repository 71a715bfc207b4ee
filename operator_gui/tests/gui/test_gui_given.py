"""Limits file and calibration record in the window: chosen, refused, remembered, and the verdicts that follow."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import json

import pytest

from mtr_operator.station.settings import Settings, settings_from_document
from mtr_operator.storage.given_files import DEFAULT_CALIBRATION, GivenPaths
from mtr_operator.storage.progress_file import open_progress

# The Car of these tests obeys up to 5.2 m from its centre.
KEPT = "limits:\n  - {name: near, what: press, at_least_m: 4.0}\n"
BROKEN = "limits:\n  - {name: far, what: press, at_least_m: 6.0, sides: [rear]}\n  - {what: press, at_least_m: 4.0}\n"
SHORT = {"interval_m": "0.5", "attempts_limit": "16"}


@pytest.fixture
def file(tmp_path):
    """file(name, text) writes a file and gives its path."""
    def write(name, text):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path
    return write


@pytest.fixture
def choose(monkeypatch, operator):
    """choose(field, path) does what a person does with the file dialog."""
    def pick(field, path):
        monkeypatch.setattr(field, "_ask", lambda *_: path)
        operator.click(field.choose)
    return pick


def measure(operator, screen):
    """Have four radials measured."""
    for name, text in {"angle_between_radials_rad": "90", **SHORT}.items():
        screen.form.fields[name].edit.setText(text)
    operator.wait(screen.start.isEnabled)
    operator.click(screen.start)
    return operator.window.measurement


def test_verdict_is_shown_while_and_after_measuring_and_kept_with_the_test(operator, choose, file):
    screen = operator.choose("key_press")
    choose(screen.given.limits, file("limits.yaml", BROKEN))
    assert screen.given.limits.field.text.endswith("limits.yaml") and not screen.given.limits.field.fault
    measurement = measure(operator, screen)
    verdict = measurement.facts.values["verdict"]
    operator.wait(lambda: operator.model.done >= 1)
    assert verdict.isVisible() and verdict.text() == "pass (1 pass)"
    assert measurement.facts.values["newest"].text().endswith("\N{EN DASH} pass")
    protocol = operator.finish()
    assert protocol.notice.text().startswith("Verdict: fail (3 pass, 1 fail).")
    table = protocol.table.model()
    last = table.columnCount() - 1
    assert table.headerData(last, 1) == "Verdict"
    assert [table.data(table.index(row, last)) for row in range(4)] == ["pass", "pass", "fail", "pass"]
    assert table.data(table.index(2, last), 3).startswith("Wanted is press at least 6 m")
    assert table.data(table.index(0, last), 3) is None
    _, _, progress = open_progress(operator.model.test.path, _scenarios())
    assert progress.limits.requirements[0].name == "far" and progress.calibration is not None


def _scenarios():
    from mtr_operator.domain.scenarios import SCENARIOS
    return SCENARIOS


def test_without_limits_nothing_is_judged(operator):
    screen = operator.choose("key_press")
    measurement = measure(operator, screen)
    operator.wait(lambda: operator.model.done >= 1)
    assert not measurement.facts.values["verdict"].isVisible() and operator.model.judgement is None
    protocol = operator.finish()
    table = protocol.table.model()
    assert table.headerData(table.columnCount() - 1, 1) == "95 % [m]"
    assert "Verdict" not in protocol.notice.text()


@pytest.mark.parametrize(("text", "words"), [
    ("limits: [", "is not valid YAML"), ("limits: []", "list of 1 to 200"),
    ("limits:\n- {what: unlock, at_least_m: 4}\n", "Key press measures no 'unlock'"),
    ("limits:\n- {what: press, at_least_m: 40}\n", "the test measures from 3 to 6.5 m only"),
    ("limits:\n- {what: press, at_least_m: 5}\n- {what: press, at_most_m: 4}\n", "contradict each other")])
def test_bad_limits_are_refused_with_their_sentence_until_they_are_taken_away(operator, choose, file, text, words):
    screen = operator.choose("key_press")
    operator.wait(screen.start.isEnabled)
    choose(screen.given.limits, file("limits.yaml", text))
    assert words in screen.given.limits.field.fault and not screen.start.isEnabled()
    operator.click(screen.given.limits.remove)
    assert not screen.given.limits.field.fault
    # A busy machine may find the robot silent for a moment.
    operator.wait(screen.start.isEnabled)


def test_limits_are_judged_anew_with_other_parameters(operator, choose, file):
    screen = operator.choose("key_press")
    choose(screen.given.limits, file("limits.yaml", "limits:\n- {what: press, at_least_m: 7}\n"))
    assert "measures from 3 to 6.5 m only" in screen.given.limits.field.fault
    screen.form.fields["maximum_distance_m"].edit.setText("9")
    assert not screen.given.limits.field.fault


def test_bad_calibration_record_is_refused_and_an_old_one_is_warned_of(operator, choose, file):
    screen = operator.choose("key_press")
    design = DEFAULT_CALIBRATION.read_text(encoding="utf-8")
    choose(screen.given.calibration, file("robot.yaml", design.replace("key_ahead_m:", "key_beside_m:")))
    assert "key_ahead_m is missing" in screen.given.calibration.field.fault and not screen.start.isEnabled()
    old = "\n".join("date: 2001-02-03" if line.startswith("date:") else
                    "valid_days: 30" if line.startswith("valid_days:") else line for line in design.splitlines())
    choose(screen.given.calibration, file("robot.yaml", old))
    assert not screen.given.calibration.field.fault
    operator.wait(screen.start.isEnabled)
    assert "The robot's calibration record of 2001-02-03 is" in screen.caution.text()


def test_dialog_that_is_cancelled_changes_nothing(operator, choose, file):
    screen = operator.choose("key_press")
    choose(screen.given.limits, file("limits.yaml", KEPT))
    choose(screen.given.limits, None)
    assert screen.given.limits.field.text.endswith("limits.yaml")


def test_files_are_remembered_limits_by_scenario(operator, choose, file, start):
    screen, limits = operator.choose("key_press"), file("limits.yaml", KEPT)
    record = file("robot.yaml", DEFAULT_CALIBRATION.read_text(encoding="utf-8"))
    choose(screen.given.limits, limits)
    choose(screen.given.calibration, record)
    measure(operator, screen)
    operator.finish()
    # While a test runs, another application would keep its window from reacting, and the robot would be stopped.
    settings = start().flow.store.settings
    assert settings.given("key_press") == GivenPaths(limits, record)
    assert settings.given("autolock") == GivenPaths(None, record)
    operator.click(operator.window.protocol.done)
    assert operator.choose("key_press").given.paths == GivenPaths(limits, record)


def test_remembered_file_that_has_gone_is_told(operator, tmp_path):
    store = operator.application.flow.store
    store.change(store.settings.with_given("key_press", GivenPaths(tmp_path / "gone.yaml", None)))
    screen = operator.choose("key_press")
    assert "gone.yaml cannot be read" in screen.given.limits.field.fault and not screen.start.isEnabled()


def test_file_that_was_changed_since_it_was_chosen_is_read_anew(operator, choose, file, monkeypatch):
    said = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message", lambda *texts: said.append(texts[-1]))
    screen = operator.choose("key_press")
    path = file("limits.yaml", KEPT)
    choose(screen.given.limits, path)
    operator.wait(screen.start.isEnabled)
    path.write_text("limits: []", encoding="utf-8")
    operator.click(screen.start)
    operator.wait(lambda: said)
    assert "list of 1 to 200" in said[0] and operator.model.test is None


def test_budget_of_the_chosen_row_is_shown(operator):
    measure(operator, operator.choose("key_press"))
    protocol = operator.finish()
    assert not protocol.budget.isVisible()
    protocol.table.selectRow(1)
    assert protocol.budget.isVisible()
    table = protocol.budget.model()
    rows = [[table.data(table.index(row, column)) for column in range(table.columnCount())]
            for row in range(table.rowCount())]
    budget = protocol.protocol.assessment.budget(2, "press")
    assert [row[0] for row in rows][-1] == "expanded uncertainty, 95 %"
    assert float(rows[-1][1]) == pytest.approx(budget.expanded_m, abs=0.0001)
    assert {row[0] for row in rows[:-1]} == {term.name for term in budget.terms}
    assert sum(float(row[1]) ** 2 for row in rows[:-1]) == pytest.approx(budget.sigma_m ** 2, rel=0.02)


def test_budget_of_a_line_with_two_distances_names_them(operator, opener):
    opener.passive = True
    operator.begin("autolock")
    protocol = operator.finish()
    protocol.table.selectRow(0)
    table = protocol.budget.model()
    assert {table.data(table.index(row, 0)) for row in range(table.rowCount())} == {"unlock", "lock"}
    assert [table.headerData(column, 1) for column in (0, 1)] == ["Distance", "Part of its uncertainty"]


def test_settings_of_an_earlier_version_have_no_files():
    document = Settings().to_document()
    del document["limits"], document["calibration"]
    assert settings_from_document(json.loads(json.dumps(document))) == Settings()
    wanted = dataclasses.replace(Settings(), limits={"key_press": DEFAULT_CALIBRATION}, calibration=DEFAULT_CALIBRATION)
    assert settings_from_document(json.loads(json.dumps(wanted.to_document()))) == wanted
