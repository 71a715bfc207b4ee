"""Colours can be read (WCAG 2.1 AA), and no control is nameless or out of the keyboard's reach."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtWidgets import QAbstractButton, QComboBox, QLineEdit, QShortcut, QTableView

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.bus.bus_window import BusWindow
from mtr_operator.gui.calibration.guide_window import GuideWindow
from mtr_operator.gui.theme.palette import THEMES, contrast
from mtr_operator.gui.theme.sheet import ICON
from mtr_operator.gui.windows.calibration_window import CalibrationWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station import settings

IMAGES = ICON.parent

TEXT = 4.5
GRAPHICS = 3.0
PAIRS = [(ink, ground) for ink in ("ink", "ink_soft", "ok", "warning", "danger", "accent")
         for ground in ("window", "surface")] + [
    ("ink", "raised"), ("ink_soft", "raised"), ("on_accent", "accent"), ("on_tint", "tint"), ("on_signal", "ok"),
    ("on_signal", "warning"), ("on_signal", "danger"), ("ink", "body"), ("first", "surface"), ("second", "surface"),
    ("failed", "surface"), ("invalid", "surface"), ("surface", "ink")]
SHAPES = [(colour, "surface") for colour in ("border", "edge", "trail", "waypoint", "key")] + [
    ("border", "window"), ("robot_mark", "robot")]


def test_contrast_of_black_and_white_is_the_largest():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("theme", list(THEMES))
@pytest.mark.parametrize(("ink", "ground"), PAIRS)
def test_text_can_be_read(theme, ink, ground):
    palette = THEMES[theme]
    assert contrast(getattr(palette, ink), getattr(palette, ground)) >= TEXT


@pytest.mark.parametrize("theme", list(THEMES))
@pytest.mark.parametrize(("shape", "ground"), SHAPES)
def test_shapes_can_be_told_from_their_ground(theme, shape, ground):
    palette = THEMES[theme]
    assert contrast(getattr(palette, shape), getattr(palette, ground)) >= GRAPHICS


@pytest.mark.parametrize(("ink", "ground"), [*PAIRS, ("on_stop", "stop")])
def test_text_of_high_contrast_is_of_level_aaa(ink, ground):
    assert contrast(getattr(THEMES["contrast"], ink), getattr(THEMES["contrast"], ground)) >= 7.0


@pytest.mark.parametrize(("shape", "ground"), [*SHAPES, ("stop", "surface"), ("line", "window")])
def test_shapes_of_high_contrast_stand_out_as_text_does(shape, ground):
    assert contrast(getattr(THEMES["contrast"], shape), getattr(THEMES["contrast"], ground)) >= TEXT


@pytest.mark.parametrize("theme", list(THEMES))
def test_theme_has_its_signs_and_can_be_chosen(theme):
    assert theme in settings.THEMES
    assert all((IMAGES / f"{sign}_{theme}.svg").is_file() for sign in ("arrow", "tick"))


def controls(window):
    """Controls of the window; parts of combo boxes and tables belong to these."""
    kinds = (QAbstractButton, QComboBox, QLineEdit, QTableView)
    return [widget for kind in kinds for widget in window.findChildren(kind)
            if not isinstance(widget.parent(), (QComboBox, QTableView))]


def assert_reachable(window, least=4):
    found = controls(window)
    keys = {shortcut.key().toString() for shortcut in window.findChildren(QShortcut)}
    assert len(found) >= least
    for control in found:
        name = control.accessibleName() or (control.text() if isinstance(control, QAbstractButton) else "")
        assert name.strip(), f"{control} of {window} has no name"
        # A button that leaves the focus on Stop names its key.
        has_key = any(f"({key})" in name for key in keys)
        assert control.focusPolicy() & Qt.TabFocus or has_key, f"{name} cannot be reached with the keyboard"


def test_every_control_has_a_name_and_is_reached_with_the_keyboard(operator, qtbot):
    flow, appearance = operator.application.flow, operator.application.appearance
    windows = [operator.window, CalibrationWindow(flow), SettingsWindow(flow, appearance),
               BusWindow(flow, appearance), GuideWindow(flow)]
    for window in windows[1:]:
        qtbot.addWidget(window)
    for name in SCENARIOS:
        assert operator.window.settings[name].start.text()
    for window in windows:
        assert_reachable(window, 2 if isinstance(window, BusWindow) else 4)


def test_connection_window_is_usable_with_the_keyboard_alone(newcomer):
    assert_reachable(newcomer.window)
    window = newcomer.window
    window.robot.host.edit.setFocus()
    newcomer.bot.keyClick(window.robot.host.edit, Qt.Key_Tab)
    assert window.focusWidget() is window.robot.subscriber_port.edit
