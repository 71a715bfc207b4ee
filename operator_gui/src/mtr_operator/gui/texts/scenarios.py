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
    QT_TRANSLATE_NOOP("Scenario", "Digital key"),
    QT_TRANSLATE_NOOP("Scenario", "Carry the phone to places around the Car, read there the distance that phone or Car "
                                  "tells, and map its error."),
    QT_TRANSLATE_NOOP("Scenario", "Sleep time"),
    QT_TRANSLATE_NOOP("Scenario", "Hold the key still near the Car, have the handle taken after ever longer rests, and "
                                  "find after which the key no longer answers."),
    QT_TRANSLATE_NOOP("Scenario", "Relay resistance"),
    QT_TRANSLATE_NOOP("Scenario", "Have the handle taken with the key beyond the zone, first with an extender switched "
                                  "off, then on, and bound how often the Car unlocks."),
)
