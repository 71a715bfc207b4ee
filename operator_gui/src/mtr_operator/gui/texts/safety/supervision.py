"""Sentences on the Car's signals, the person in charge, the preflight and what a test may do to people nearby."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "The Car's ignition is on (signal {})."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's gear is not P (signal {})."),
    QT_TRANSLATE_NOOP("Sentence", "The Car moves (signal {})."),
    QT_TRANSLATE_NOOP("Sentence", "A door or lid of the Car is open: {} (signal {})."),
    QT_TRANSLATE_NOOP("Sentence", "The robot was stopped. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot was stopped. {} Secure the Car, then continue the test."),
    QT_TRANSLATE_NOOP("Sentence", "No output at the Car is switched. {}"),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} of {} must be a table of message, signal and parked; bus and "
                                  "unknown are optional."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} of {} has no parked value: the robot could never move."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} of {} lists no parked value that the signal {} can carry."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} of {} lists {} as parked and as unknown."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} of {} has {}: {}; allowed is a list of whole numbers."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody confirmed within {} s to be present: the robot was stopped. The test is "
                                  "kept; resume it in sight of the robot."),
    QT_TRANSLATE_NOOP("Sentence", "Presence confirmed."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot without a person: nobody can be asked here, and the "
                                  "configuration declares no unattended_stop (laboratory.yaml), the name of a rated "
                                  "stop."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot without a person in charge: name one under Car, key "
                                  "and operator, or as person_in_charge of the identity file."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot before its operating conditions are confirmed: {}."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot that does not report its preflight; update its "
                                  "software, then run `rosrun mtr_commissioning preflight --drive` on it."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot before a preflight in motion, since its start or its "
                                  "last update: run `rosrun mtr_commissioning preflight --drive` on it."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot before a preflight in motion; the last one was made "
                                  "at rest: run `rosrun mtr_commissioning preflight --drive` on it."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins on a real robot whose preflight in motion was made {} ago; allowed "
                                  "are {}: run `rosrun mtr_commissioning preflight --drive` on it."),
    QT_TRANSLATE_NOOP("Sentence", "A press may sound the horn or the alarm, or open the tailgate. Announce the test; "
                                  "people next to the Car wear ear protection."),
    QT_TRANSLATE_NOOP("Sentence", "A pull at the handle of a locked Car may set off its alarm. Announce the test; "
                                  "people next to the Car wear ear protection."),
    QT_TRANSLATE_NOOP("Sentence", "The Car may sound its horn when it locks or unlocks. Announce the test; people next "
                                  "to the Car wear ear protection."),
)
