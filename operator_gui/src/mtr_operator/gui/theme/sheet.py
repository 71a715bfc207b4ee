"""The style sheet of all windows, made from a palette and the scale.

It also makes each label and tool tip plain: what people, robots and files say is never markup.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import string

from .palette import Palette
from .scale import BODY_PT, CONTROL_HEIGHT, HEADING_PT, LARGE_PT, RADIUS, SMALL_PT, TABLE_PT, TITLE_PT

_IMAGES = (pathlib.Path(__file__).parent / "images").as_posix()
# Of all windows.
ICON = pathlib.Path(_IMAGES) / "icon.svg"

_SHEET = string.Template("""
* { font-size: ${body_pt}pt; color: $ink; }
QMainWindow, QDialog, QWidget#page { background: $window; }
QWidget#header { background: $surface; border-bottom: 2px solid $line; }
QFrame#card { background: $surface; border: 1px solid $line; border-radius: ${radius}px; }
QFrame#popup { background: $surface; border: 2px solid $border; }
QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; border: none; }
QLabel { background: transparent; }
QLabel, QToolTip { qproperty-textFormat: PlainText; }
QLabel[role="title"] { font-size: ${title_pt}pt; font-weight: 600; }
QLabel[role="heading"] { font-size: ${heading_pt}pt; font-weight: 600; }
QLabel[role="large"] { font-size: ${large_pt}pt; font-weight: 600; }
QLabel[role="soft"] { color: $ink_soft; }
QLabel[check="good"] { color: $ok; font-weight: 700; }
QLabel[check="note"], QLabel[check="unknown"] { color: $warning; font-weight: 700; }
QLabel[check="bad"] { color: $danger; font-weight: 700; }
QLabel[stale="true"] { color: $ink_soft; font-style: italic; }
QLabel[role="hint"] { color: $ink_soft; font-size: ${small_pt}pt; }
QLabel[role="error"] { color: $danger; font-size: ${small_pt}pt; font-weight: 600; }
QLabel[role="banner"] { background: $surface; color: $danger; border: 2px solid $danger; border-radius: ${radius}px;
    padding: 10px 14px; font-weight: 600; }
QLabel[role="notice"] { background: $tint; color: $on_tint; border-radius: ${radius}px; padding: 10px 14px; }
QPushButton { background: $raised; border: 1px solid $border; border-radius: ${radius}px; padding: 8px 18px;
    min-height: ${button_height}px; font-weight: 600; outline: none; }
QPushButton:hover { border: 2px solid $accent; padding: 7px 17px; }
QPushButton:focus { border: 3px solid $accent; padding: 6px 16px; }
QPushButton:pressed, QPushButton:checked { background: $tint; color: $on_tint; }
QPushButton:disabled { color: $ink_soft; background: $window; border: 1px dashed $border; font-weight: 400; }
QPushButton[role="primary"] { background: $accent; color: $on_accent; border-color: $accent; }
QPushButton[role="primary"]:hover, QPushButton[role="primary"]:focus { border-color: $ink; }
QPushButton[role="primary"]:disabled { color: $ink_soft; background: $window; border: 1px dashed $border; }
QPushButton[role="danger"] { background: $danger; color: $on_signal; border-color: $danger; }
QPushButton[role="danger"]:hover, QPushButton[role="danger"]:focus { border-color: $ink; }
QPushButton[role="danger"]:disabled { color: $ink_soft; background: $window; border: 1px dashed $border; }
QPushButton[role="stop"] { background: $surface; color: $danger; border: 2px solid $danger; font-weight: 700; }
QPushButton[role="stop"][moving="true"] { background: $stop; color: $on_stop; border: 2px solid $stop; }
QPushButton[role="stop"]:focus { border: 3px solid $ink; padding: 6px 16px; }
QPushButton[role="tool"] { padding: 8px 8px; }
QPushButton[role="tool"]:hover { padding: 7px 7px; }
QPushButton[role="tool"]:focus { padding: 6px 6px; }
QPushButton[role="tile"] { font-size: ${large_pt}pt; padding: 18px 24px; text-align: left; }
QPushButton[role="flat"] { background: transparent; border: 2px solid transparent; padding: 3px 4px; color: $accent;
    text-align: left; min-height: 28px; }
QPushButton[role="flat"]:hover { text-decoration: underline; border: 2px solid transparent; padding: 3px 4px; }
QPushButton[role="flat"]:checked { background: transparent; color: $accent; }
QPushButton[role="flat"]:focus { border: 2px solid $accent; padding: 3px 4px; }
QPushButton[word] { min-height: 32px; padding: 4px 10px; border-radius: 20px; color: $on_signal; }
QPushButton[word="ready"] { background: $ok; border-color: $ok; }
QPushButton[word="ready with warnings"] { background: $warning; border-color: $warning; }
QPushButton[word="not ready"], QPushButton[word="communication lost"],
QPushButton[word="blocked"] { background: $danger; border-color: $danger; }
QPushButton[word="measuring"], QPushButton[word="driving"], QPushButton[word="mapping"],
QPushButton[word="checking"] { background: $accent; border-color: $accent; color: $on_accent; }
QPushButton[word="paused"] { background: $warning; border-color: $warning; }
QPushButton[word]:hover { border-color: $ink; padding: 3px 9px; }
QPushButton[word]:focus { border-color: $ink; padding: 2px 8px; }
QLineEdit, QComboBox { background: $surface; border: 1px solid $border; border-radius: 6px; padding: 6px 10px;
    min-height: ${field_height}px; selection-background-color: $accent; selection-color: $on_accent; }
QPlainTextEdit { background: $surface; border: 1px solid $border; border-radius: 6px; padding: 4px 8px;
    selection-background-color: $accent; selection-color: $on_accent; }
QPlainTextEdit:focus { border: 2px solid $accent; padding: 3px 7px; }
QPlainTextEdit[faulty="true"] { border: 2px solid $danger; padding: 3px 7px; }
QLineEdit:focus, QComboBox:focus { border: 2px solid $accent; padding: 5px 9px; }
QLineEdit[faulty="true"], QComboBox[faulty="true"] { border: 2px solid $danger; padding: 5px 9px; }
QLineEdit:read-only { background: $window; border: 1px solid $line; }
QLineEdit:disabled, QComboBox:disabled { color: $ink_soft; background: $window; }
QComboBox::drop-down { border: none; width: 34px; }
QComboBox::down-arrow { image: url("$images/arrow_$name.svg"); width: 16px; height: 16px; }
QComboBox QAbstractItemView { background: $surface; selection-background-color: $accent;
    selection-color: $on_accent; border: 1px solid $border; }
QCheckBox { spacing: 10px; background: transparent; min-height: 32px; }
QCheckBox::indicator { width: 22px; height: 22px; border: 2px solid $border; border-radius: 4px; background: $surface; }
QCheckBox::indicator:checked { background: $accent; border-color: $accent; image: url("$images/tick_$name.svg"); }
QCheckBox::indicator:focus { border-color: $ink; }
QProgressBar { background: $raised; border: 1px solid $border; border-radius: 6px; min-height: 22px; max-height: 22px;
    text-align: center; color: transparent; }
QProgressBar::chunk { background: $accent; border-radius: 5px; }
QTableView { font-size: ${table_pt}pt; background: $surface; alternate-background-color: $window; gridline-color: $line;
    border: 1px solid $line; selection-background-color: $accent; selection-color: $on_accent; }
QTableView:focus { border: 2px solid $accent; }
QHeaderView::section { font-size: ${table_pt}pt; background: $raised; color: $ink; border: none;
    border-right: 1px solid $line; border-bottom: 1px solid $border; padding: 6px 8px; font-weight: 600; }
QTableCornerButton::section { background: $raised; border: none; }
QToolTip { background: $ink; color: $surface; border: 1px solid $border; padding: 6px; }
QToolButton { background: transparent; border: 2px solid transparent; border-radius: ${radius}px; padding: 4px; }
QToolButton:hover { background: $raised; }
QToolButton:focus { border-color: $accent; }
QToolButton:checked { background: $tint; color: $on_tint; }
QScrollBar:vertical { background: $window; width: 14px; }
QScrollBar::handle:vertical { background: $border; border-radius: 5px; min-height: 40px; margin: 2px; }
QScrollBar:horizontal { background: $window; height: 14px; }
QScrollBar::handle:horizontal { background: $border; border-radius: 5px; min-width: 40px; margin: 2px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QSplitter::handle { background: $line; }
""")


def style_sheet(name: str, palette: Palette) -> str:
    """Style sheet of the application in the colours of a theme."""
    sizes = {"small_pt": SMALL_PT, "table_pt": TABLE_PT, "body_pt": BODY_PT, "large_pt": LARGE_PT,
             "heading_pt": HEADING_PT, "title_pt": TITLE_PT, "radius": RADIUS, "button_height": CONTROL_HEIGHT - 20,
             "field_height": CONTROL_HEIGHT - 18}
    return _SHEET.substitute(vars(palette), name=name, images=_IMAGES, **sizes)
