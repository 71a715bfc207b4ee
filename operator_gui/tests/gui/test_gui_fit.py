"""Every screen of the main window fits every screen: nothing is cut or elided, and Stop is always inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest
from fit_checks import CAR, WANTED, assert_fits, tell
from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.identity.identity import TITLES
from mtr_operator.domain.identity.laboratory import laboratory_from
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import Notification
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.flow import Step
from mtr_operator.gui.screens import measurement_facts
from mtr_operator.history.entry import TestEntry
from mtr_operator.station.events import ActionBegun, LinesPlanned
from mtr_operator.station.readiness import Phase
from mtr_operator.station.test import Test
from mtr_operator.station.view_model import ViewModel

HELD = "The robot is held by an obstacle; it stands until the Operator looks at the cause and has it go on."


def test_main_window_fits_with_stop_in_sight__A2(main, monkeypatch):
    assert main.header.stop.isVisible()
    assert_fits(main, monkeypatch, WANTED)


def test_main_window_of_a_robot_that_obeys_another_application_fits(application, main, monkeypatch):
    tell(application, controlled_by_other=True)
    assert main.header.foreign.isVisible()
    assert_fits(main, monkeypatch, WANTED)


@pytest.mark.parametrize("name", ["type", *SCENARIOS])
def test_choices_and_parameters_fit__B5(application, main, monkeypatch, name):
    application.flow.show(Step.TYPE)
    if name != "type":
        main.types.chosen.emit(name)
    assert_fits(main, monkeypatch, WANTED)


@pytest.mark.parametrize("name", ["autolock", "key_press"])
def test_parameters_fit_with_the_longest_sentences_and_the_picture_is_seen(application, main, monkeypatch, name):
    tell(application, car=None, battery_percent=5)
    main.types.chosen.emit(name)
    screen = main.settings[name]
    screen.caution.setText("At 3.6 km/h, with a message of the Car every 0.20 s, the distance of a pass has a sigma of "
                           "0.058 m by that message alone; the parameter asks for 0.030 m. Pass at 1.836 km/h.")
    screen.caution.show()
    assert_fits(main, monkeypatch, WANTED)
    assert screen.picture.view.height() >= 100


@pytest.mark.parametrize("size", [QSize(1360, 860), QSize(1008, 660)])
def test_preview_has_its_tools_in_sight(application, main, size):
    tell(application)
    main.types.chosen.emit("autolock")
    screen = main.settings["autolock"]
    main.resize(size)
    QApplication.processEvents()
    ruler = screen.picture.ruler
    assert ruler.visibleRegion().boundingRect() == ruler.rect()


@pytest.mark.parametrize("size", [QSize(1350, 696), QSize(1008, 660)])
def test_what_speaks_against_the_parameters_is_seen_without_scrolling(application, main, size):
    tell(application)
    main.types.chosen.emit("autolock")
    screen = main.settings["autolock"]
    main.resize(size)
    screen.form.fields["maximum_distance_m"].edit.setText("0.4")
    screen.caution.setText("Something stands in the way of axis 7.")
    screen.caution.show()
    QApplication.processEvents()
    for label in (screen.form.fault, screen.caution):
        assert label.isVisible() and label.visibleRegion().boundingRect() == label.rect(), label.text()


def test_identity_fits_with_what_is_missing(application, main, monkeypatch):
    main.types.chosen.emit("key_press")
    form = main.settings["key_press"].identity
    form.propose(application.flow.store)
    form._laboratory = laboratory_from({"required": list(TITLES)})
    form.more.setChecked(True)
    form.fields["key_battery_v"].show_text("75")
    form.fields["equipment"].show_text("multimeter; 77; soon")
    form.photos.show_paths((pathlib.Path("/photos/a_photo_of_the_car_from_the_front_left.jpg"),))
    assert form.fault.isVisible() and form.fields["equipment"].note.isVisible()
    assert_fits(main, monkeypatch, WANTED)
    form.more.setChecked(False)
    assert_fits(main, monkeypatch, WANTED)


ENTRIES = [TestEntry(f"/tests/{number}.json", "", str(number), 9, f"2026-11-{number:02d}T15:36:43+01:00", "key_press",
                     "Golf VIII Variant WVWZZZ1KZAW000001", "K-0042-A", "Nov\u00e1kov\u00e1", "Hall 2, row 4", 8, 8, 0,
                     True, "inconclusive", "x") for number in range(1, 25)]


def test_history_fits(application, main, monkeypatch):
    monkeypatch.setattr(main.history, "read", lambda _: None)
    main.welcome.history.emit()
    path = f"/home/operator{8 * '/a_folder_of_tests'}/broken.json"
    broken = TestEntry(path, f"The test cannot be continued from {path}. It is damaged: parts of it are missing or of "
                       "the wrong kind.")
    main.history._learn_all([*ENTRIES, broken])
    main.history.table.selectRow(0)
    assert main.screen is main.history and len(main.history.shown) == 24
    assert_fits(main, monkeypatch, WANTED)


def take_up(application, tmp_path, phase):
    """A test of axes is at hand."""
    scenario = SCENARIOS["autolock"]
    parameters = scenario.parameters_type()
    application.flow.model.take_up(
        Test(scenario, parameters, Progress(scenario.name, parameters, car=CAR), tmp_path / "progress.json"))
    application.flow.model.phase = phase


@pytest.mark.parametrize("phase", [Phase.MEASURING, Phase.PAUSED])
def test_measurement_fits_with_all_its_banners__B5(application, main, monkeypatch, tmp_path, phase):
    take_up(application, tmp_path, phase)
    application.flow.model.trouble = "The robot has been silent for 30 s; check the Wi-Fi and that its software runs."
    application.flow.show(Step.MEASUREMENT)
    main.measurement.say("Saved to /home/operator/Documents/mtr/progress/autolock_2026-11-22_15-36-43.json")
    tell(application, LinesPlanned(2, 28, CAR), ActionBegun("axis 3 (front left): go to the start"), hold_id=3,
         notifications=(Notification("held", 3, HELD), Notification("peripherals", 2, "The lift is slow.")))
    assert main.measurement.go_on.isVisible()
    assert main.header.blocked.isVisible() is (phase is Phase.MEASURING)
    assert_fits(main, monkeypatch, WANTED)


def test_last_result_is_in_sight_on_a_small_laptop_while_the_robot_is_silent__B5(application, main, tmp_path,
                                                                                  monkeypatch):
    take_up(application, tmp_path, Phase.MEASURING)
    application.flow.show(Step.MEASUREMENT)
    tell(application, LinesPlanned(2, 28, CAR), ActionBegun("axis 3 (front left): go to the start"))
    monkeypatch.setattr(ViewModel, "is_stale", True)
    monkeypatch.setattr(measurement_facts, "newest_text", lambda _: "2 (front left): unlock 1.220 m, lock 2.250 m")
    main.resize(QSize(1350, 696))
    main.measurement.show_model()
    QApplication.processEvents()
    newest = main.measurement.facts.values["newest"]
    assert newest.height() > 1.5 * newest.fontMetrics().height(), "one row only"
    assert newest.visibleRegion().boundingRect() == newest.rect()


def test_protocol_fits(application, main, monkeypatch, tmp_path):
    take_up(application, tmp_path, Phase.FINISHED)
    application.flow.show(Step.PROTOCOL)
    assert_fits(main, monkeypatch, WANTED)


@pytest.mark.parametrize("size", [QSize(1350, 696), QSize(1008, 660)])
def test_protocol_on_a_small_laptop_needs_no_scrolling(application, main, tmp_path, size):
    take_up(application, tmp_path, Phase.FINISHED)
    application.flow.show(Step.PROTOCOL)
    main.resize(size)
    QApplication.processEvents()
    for widget in (main.protocol.title, main.protocol.done):
        assert widget.visibleRegion().boundingRect() == widget.rect(), widget.text()


@pytest.mark.parametrize(("scenario", "columns"), [("key_press", 4), ("autolock", 4)])
def test_protocol_with_results_fits(operator, opener, monkeypatch, scenario, columns):
    opener.passive = scenario == "autolock"
    operator.begin(scenario)
    protocol = operator.finish()
    protocol.table.selectRow(0)
    assert protocol.table.model().columnCount() >= columns and protocol.budget.isVisible()
    assert_fits(operator.window, monkeypatch, WANTED)
