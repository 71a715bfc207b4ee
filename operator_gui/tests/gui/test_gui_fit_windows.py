"""Windows beside the main one fit every screen, and their Stop is always inside."""
# SPDX-License-Identifier: Apache-2.0
from fit_checks import CAR, assert_fits, faults, visible
from PyQt5.QtCore import QRect, QSize
from PyQt5.QtWidgets import QApplication, QLabel, QLineEdit, QWidget

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.gui.fitting import place
from mtr_operator.gui.forms.adapters.bus_forms import BusForm
from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.gui.history.comparison_window import ComparisonWindow
from mtr_operator.gui.history.spread_window import SpreadWindow
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.connection_window import ConnectionWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.history.line_pairs import Side
from mtr_operator.history.spread import spread_of
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.station.connection import BusChoice, CanChoice, Connection


def test_connection_window_fits__B6(application, show, monkeypatch):
    window = show(lambda: ConnectionWindow(application.flow, Connection()))
    assert_fits(window, monkeypatch)
    window.can.interface.setCurrentIndex(1)
    window._show_refusal("robot", "No answer from the subscriber port 3334 of 192.168.0.10; is the robot on?")
    assert_fits(window, monkeypatch)
    window.pairing._show_refusal("192.168.0.300 is no address of a robot that is reached.")
    window.robot.host.show_fault("Robot address is 192.168.0.300; an IPv4 address is four numbers from 0 to 255.")
    window.can.interface.setCurrentIndex(window.can.interface.count() - 1)
    assert_fits(window, monkeypatch)


def test_adapters_of_three_buses_fit(application, main, show, monkeypatch, tmp_path):
    # A path that is typed may be longer than its line, and that of this folder is.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "car.yaml").write_text(
        "database: car.dbc\nmessage: State\nsignal: Lock\nstates: {0: locked, 1: unlocked}\ncycle_time_s: 0.1\n"
        "buses: {body: car.dbc, diagnostics_behind_the_gateway_of_the_left_doors: car.dbc}\n", encoding="utf-8")
    choice = CanChoice("slcan", "/dev/ttyACM0", profile="car.yaml",
                       further=(BusChoice("body", "slcan", "/dev/ttyACM1"),))
    window = show(lambda: ConnectionWindow(application.flow, Connection(can=choice)))
    window._show_refusal("car", "Further bus body: There is no CAN adapter at /dev/ttyACM1; check the channel and the "
                                "USB plug.", "body")
    assert len(visible(window, BusForm)) == 2
    assert_fits(window, monkeypatch)
    settings = show(lambda: SettingsWindow(application.flow, application.appearance, main))
    settings.can.show_choice(choice)
    assert len(visible(settings, BusForm)) == 2
    assert_fits(settings, monkeypatch)


def test_calibration_fits_and_has_its_stop_in_sight__B6(application, main, show, monkeypatch):
    window = show(lambda: CalibrationWindow(application.flow, main))
    assert visible(window, StopButton)
    assert_fits(window, monkeypatch, window.wanted_size())


def test_calibration_on_a_small_laptop_has_all_its_buttons_in_sight(application, main, show):
    window = show(lambda: CalibrationWindow(application.flow, main))
    window.resize(window.wanted_size().boundedTo(QSize(1356, 696)))
    QApplication.processEvents()
    for button in (window.car.check, window.car.map, window.send):
        assert button.visibleRegion().boundingRect() == button.rect(), button.text()


def test_calibration_opens_without_a_scroll_bar_where_there_is_room(application, main, show, monkeypatch):
    monkeypatch.setattr(place, "available", lambda _: QRect(0, 0, 1920, 1080))
    window = show(lambda: CalibrationWindow(application.flow, main))
    window.notice.setText("Pressed for 0.30 s. The Car has not answered to it.")
    QApplication.processEvents()
    for label in window.findChildren(QLabel):
        assert label.isHidden() or label.visibleRegion().boundingRect() == label.rect(), label.text()


def test_settings_fit_and_have_their_stop_in_sight__B6(application, main, show, monkeypatch):
    window = show(lambda: SettingsWindow(application.flow, application.appearance, main))
    assert visible(window, StopButton)
    assert_fits(window, monkeypatch)


def measured_side(day, far_m):
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type(method="adaptive")
    return Side(scenario, parameters, Progress(
        scenario.name, parameters.to_mapping(), {"started": f"2026-11-2{day}T15:36:43+01:00"}, CAR,
        [KeyPressResult(number, 45.0 * (number - 1), LineStatus.OK, far_m, None, 0.01, 9, 1.0, "", method="adaptive",
                        reach="measured", d50_m=far_m, d50_sigma_m=0.1, d50_low_m=far_m - 0.2, d50_high_m=far_m + 0.2)
         for number in range(1, 9)], identity=Identity("WVWZZZ1KZAW000001", f"Golf {day}")))


def test_comparison_fits_and_has_its_stop_in_sight(application, main, show, monkeypatch):
    sides = measured_side(1, 4.0), measured_side(2, 6.0)
    window = show(lambda: ComparisonWindow(compare_sets(sides[:1], sides[1:]), application.appearance, main))
    # Eight radials, right and left side, all lines, and the area.
    assert visible(window, StopButton) and window.table.model().rowCount() == 12
    assert_fits(window, monkeypatch, QSize(1300, 760))


def test_spread_fits_and_has_its_stop_in_sight(application, main, show, monkeypatch):
    found = spread_of([measured_side(day, 4.0 + 0.1 * day) for day in (1, 2, 4)])
    window = show(lambda: SpreadWindow(found, application.appearance, main))
    assert visible(window, StopButton) and window.table.model().rowCount() == 8
    assert_fits(window, monkeypatch, QSize(1300, 760))


def test_text_that_is_cut_is_noticed(show):
    label = QLabel("A sentence that has no room.")
    holder = QWidget()
    holder.resize(40, 20)
    label.setParent(holder)
    assert len(faults(show(lambda: holder))) == 1


def test_hint_that_is_cut_in_its_line_is_noticed(show):
    line, holder = QLineEdit(), QWidget()
    line.setPlaceholderText("A hint that has no room in its line")
    line.resize(80, 40)
    holder.resize(700, 60)
    line.setParent(holder)
    window = show(lambda: holder)
    assert faults(window) == ["'A hint that has no room in its line' is cut in its line"]
    line.setText("gone")
    assert faults(window) == []
    line.clear()
    line.resize(600, 40)
    assert faults(window) == []
