"""Texts of people, robots and files are text in every label, whatever they look like."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtWidgets import QApplication, QLabel, QMessageBox, QToolTip

MARKUP = "<b>stop</b><img src='http://192.0.2.1/x'>"


def formats(widget):
    return {label.textFormat() for label in widget.findChildren(QLabel)}


@pytest.mark.parametrize("when", ["before", "after"])
def test_label_shows_markup_as_it_is(operator, when):
    label = QLabel(MARKUP if when == "before" else "", operator.window)
    label.show()
    label.setText(MARKUP)
    assert label.textFormat() == Qt.TextFormat.PlainText


def test_message_box_shows_markup_as_it_is(operator):
    box = QMessageBox(QMessageBox.Icon.Warning, "title", MARKUP, QMessageBox.StandardButton.Ok, operator.window)
    box.setInformativeText(MARKUP)
    box.show()
    assert formats(box) == {Qt.TextFormat.PlainText}
    box.close()


def test_tool_tip_shows_markup_as_it_is(operator):
    QToolTip.showText(QPoint(10, 10), MARKUP, operator.window)
    tips = [each for each in QApplication.topLevelWidgets() if each.inherits("QTipLabel")]
    assert tips and {tip.textFormat() for tip in tips} == {Qt.TextFormat.PlainText}
    QToolTip.hideText()


def test_every_visible_label_of_the_window_is_plain(operator):
    labels = [label for label in operator.window.findChildren(QLabel) if label.isVisible()]
    assert labels and {label.textFormat() for label in labels} == {Qt.TextFormat.PlainText}
