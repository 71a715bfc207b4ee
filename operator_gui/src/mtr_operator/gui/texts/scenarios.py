"""Names of the scenarios, and a sentence on each."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Scenario", "Autolock"),
    QT_TRANSLATE_NOOP("Scenario", "Approach until the Car unlocks, retreat backwards until it locks, on every axis."),
    QT_TRANSLATE_NOOP("Scenario", "Key press"),
    QT_TRANSLATE_NOOP("Scenario", "Press a button on every radial, and find from how far the Car obeys."),
    QT_TRANSLATE_NOOP("Scenario", "Zone map"),
    QT_TRANSLATE_NOOP("Scenario", "Press a button where it tells most, in every zone around the Car, and draw the "
                                  "map of where it works."),
    QT_TRANSLATE_NOOP("Scenario", "Handle request"),
    QT_TRANSLATE_NOOP("Scenario", "Have the handle taken with the key at places on every axis, and find where the Car "
                                  "takes the key for outside."),
)
