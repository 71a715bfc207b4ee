"""Sentences on passes of an axis at several speeds, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "warning: {}"),
    QT_TRANSLATE_NOOP("Sentence", "pass {}: approach until the Car unlocks"),
    QT_TRANSLATE_NOOP("Sentence", "warning: pass {} of this axis was not measured. {}"),
    QT_TRANSLATE_NOOP("Sentence", "All passes have about the same speed, so that the Car's reaction time stays inside "
                                  "the distances; give measuring_speeds_mps two speeds."),
    QT_TRANSLATE_NOOP("Sentence", "At {}, with a message of the Car every {} s, the static boundary of an axis has a "
                                  "sigma of {} m; boundary_sigma_m asks for {} m. {}"),
    QT_TRANSLATE_NOOP("Sentence", "At {}, with a message of the Car every {} s, the distance of a pass has a sigma of "
                                  "{} m by that message alone; boundary_sigma_m asks for {} m. {}"),
    QT_TRANSLATE_NOOP("Sentence", "Pass at {}."),
    QT_TRANSLATE_NOOP("Sentence", "Ask for {} m, and pass at {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameters measuring_speed_mps and measuring_speeds_mps are both given; give one."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter passes is {}; allowed is at least one for each of the {} speeds of "
                                  "measuring_speeds_mps."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed is a list of numbers, {}."),
)
