"""Sentences about service mode, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "The robot's software is too old for service mode; update it, or switch the robot "
                                  "off for work on it."),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not enter service mode; switch it off before you work on it."),
    QT_TRANSLATE_NOOP("Sentence", "Another application controls the robot: release service mode there."),
    QT_TRANSLATE_NOOP("Sentence", "The robot was not released on its own side in time; service mode remains active."),
    QT_TRANSLATE_NOOP("Sentence", "The robot has not answered for {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Enter service mode."),
    QT_TRANSLATE_NOOP("Sentence", "Release service mode."),
)
