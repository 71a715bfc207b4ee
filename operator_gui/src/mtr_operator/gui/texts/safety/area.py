"""Sentences about the test area, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "A test area has {} corners; the number must be between {} and {}."),
    QT_TRANSLATE_NOOP("Sentence", "Corners of a test area must be within {} m of where the robot started."),
    QT_TRANSLATE_NOOP("Sentence", "Two neighbouring corners of the test area are at the same place."),
    QT_TRANSLATE_NOOP("Sentence", "The border of the test area crosses itself."),
    QT_TRANSLATE_NOOP("Sentence", "The test area is {} m2 large; it must be between {} and {} m2."),
    QT_TRANSLATE_NOOP("Sentence", "Corner {} of the test area must be two numbers, x and y in m, such as 4.0 -2.5."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not know its position yet, so it cannot keep a test area."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's launch file sets its test area; begin the test without another one."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's software is too old to keep a test area; update it, or begin without "
                                  "one."),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not accept the test area. {}"),
    QT_TRANSLATE_NOOP("Sentence", "No test begins. {}"),
)
