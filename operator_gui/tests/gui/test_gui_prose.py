"""Sentences in rows."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtWidgets import QLabel

from mtr_operator.gui.fitting.prose import Prose, together


@pytest.mark.parametrize(("text", "kept"), [
    ("no 95 % interval", "no 95_% interval"), ("every 0,20 s, then", "every 0,20_s, then"),
    ("at 3.6 km/h and 5 min", "at 3.6_km/h and 5_min"), ("9 to 24 presses", "9 to 24 presses"),
    ("8 m\u00e9n\u011b", "8 m\u00e9n\u011b"), ("line 7 s", "line 7_s"), ("", "")])
def test_figure_stays_with_its_unit(text, kept):
    assert together(text) == kept.replace("_", "\N{NO-BREAK SPACE}")


def test_label_says_what_it_was_given_and_breaks_no_figure(qtbot):
    label = Prose("The distances will have no 95 % interval.")
    qtbot.addWidget(label)
    assert label.wordWrap()
    for text in ("The distances will have no 95 % interval.", "At 80 %."):
        label.setText(text)
        assert label.text() == text
        assert QLabel.text(label) == together(text) != text
