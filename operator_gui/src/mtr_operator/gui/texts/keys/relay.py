"""Sentences on relay attacks with an extender, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "switch the extender off"),
    QT_TRANSLATE_NOOP("Sentence", "switch the extender on"),
    QT_TRANSLATE_NOOP("Sentence", "The extender was switched off."),
    QT_TRANSLATE_NOOP("Sentence", "The extender was switched on."),
    QT_TRANSLATE_NOOP("Sentence", "handle request at {} m: the Car has to unlock there"),
    QT_TRANSLATE_NOOP("Sentence", "handle request at {} m, extender off"),
    QT_TRANSLATE_NOOP("Sentence", "handle request at {} m, extender on"),
    QT_TRANSLATE_NOOP("Sentence", "not resistant: with the extender {} of {} unlocked, up to {} m"),
    QT_TRANSLATE_NOOP("Sentence", "resistant but for at most {} % (95 %): with the extender {} of {} unlocked"),
    QT_TRANSLATE_NOOP("Sentence", "zone beyond its border: without the extender {} of {} unlocked, up to {} m"),
    QT_TRANSLATE_NOOP("Sentence", "Nobody switches the extender: the Car's profile declares no extender_switch, and "
                                  "there is no Operator to ask; add one to the profile, or start the test where a "
                                  "person can answer."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody has switched the extender within {} s; continue the test when somebody is "
                                  "there to do it, or increase switch_timeout_s."),
    QT_TRANSLATE_NOOP("Sentence", "The Car did not unlock at {} requests at {} m, inside its zone: the key sleeps, its "
                                  "battery is empty, it is not the Car's key, or the handle of this side was not "
                                  "taken; its silence beyond the border says nothing."),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key was at {} m, with 1 sigma of {} m: not surely beyond the nominal "
                                  "border at {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m is {} m; it has to be at most border_distance_m, {} "
                                  "m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter places_m has {} m; allowed is {} m, which is {} m beyond "
                                  "border_distance_m, to {} m, maximum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: extender_switch must be a table of {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: extender_switch has {}: {}; allowed is a whole number."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} and {} of {} are both {}; give two values."),
    QT_TRANSLATE_NOOP("Sentence", "The car's profile names an output that switches the extender, and the CAN adapter "
                                  "only listens: a person switches it; choose normal mode (--can-normal) to have it "
                                  "switched."),
    QT_TRANSLATE_NOOP("Sentence", "The Car did not unlock inside its zone, so that its silence beyond the border says "
                                  "nothing."),
)
PARAMETERS = (
    QT_TRANSLATE_NOOP("ParameterDoc", "Side or corner of the Car at which the extender is tried: that of the handle "
                                      "that is taken."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Where the key has to unlock the Car, well inside the zone: a key that is not "
                                      "heard there says nothing by its silence farther away."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Nominal border of the zone; an unlock beyond it is one too many."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Farthest place at which the key is carried, and starting distance of each "
                                      "axis."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Places beyond the border at which the handle is taken, up to 8. Without it half "
                                      "way from the border to the farthest place, and there."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Requests at each place with the extender off, and again with it on."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the Operator may take to switch the extender before the test is "
                                      "interrupted."),
)
WORDS = (
    QT_TRANSLATE_NOOP("Word", "relay"),
    QT_TRANSLATE_NOOP("Word", "Farthest unlock, extender on"),
    QT_TRANSLATE_NOOP("Word", "Unlocked beyond the border"),
    QT_TRANSLATE_NOOP("Word", "Stayed locked, extender on"),
)
