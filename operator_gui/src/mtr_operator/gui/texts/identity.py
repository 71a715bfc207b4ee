"""Parts of a test's identity, see domain/identity, and the sentences on them."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

TITLES = (
    QT_TRANSLATE_NOOP("Identity", "Car's VIN"),
    QT_TRANSLATE_NOOP("Identity", "Car's model"),
    QT_TRANSLATE_NOOP("Identity", "Car's software"),
    QT_TRANSLATE_NOOP("Identity", "Key's serial number"),
    QT_TRANSLATE_NOOP("Identity", "Key's type"),
    QT_TRANSLATE_NOOP("Identity", "Key's battery"),
    QT_TRANSLATE_NOOP("Identity", "Operator"),
    QT_TRANSLATE_NOOP("Identity", "Person in charge"),
    QT_TRANSLATE_NOOP("Identity", "Place"),
    QT_TRANSLATE_NOOP("Identity", "Weather"),
    QT_TRANSLATE_NOOP("Identity", "Notes"),
    QT_TRANSLATE_NOOP("Identity", "Equipment"),
    QT_TRANSLATE_NOOP("Identity", "Photos"),
)
SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "A test of the scenario {} and one of {} cannot be compared; choose two of one "
                                  "scenario."),
    QT_TRANSLATE_NOOP("Sentence", "A test that has measured nothing cannot be compared."),
    QT_TRANSLATE_NOOP("Sentence", "It is invalid in test {}."),
    QT_TRANSLATE_NOOP("Sentence", "Test {} does not say how sure this distance is."),
    QT_TRANSLATE_NOOP("Sentence", "No test fits."),
    QT_TRANSLATE_NOOP("Sentence", "{} tests fit; at most {} are looked at together. Narrow the search."),
    QT_TRANSLATE_NOOP("Sentence", "Tests of the scenarios {} cannot be looked at together; choose one."),
    QT_TRANSLATE_NOOP("Sentence", "No test measured it."),
    QT_TRANSLATE_NOOP("Sentence", "One test that does not say how sure it is."),
    QT_TRANSLATE_NOOP("Sentence", "The tests tell different things here, such as a boundary and the place of one "
                                  "event; choose tests that were measured alike."),
    QT_TRANSLATE_NOOP("Sentence", "{} tests have a value here; {} are the fewest."),
    QT_TRANSLATE_NOOP("Sentence", "All tests have the same value."),
    QT_TRANSLATE_NOOP("Sentence", "The test in {} cannot be read: {}: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The test does not start: the laboratory requires {}."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with another {}, {}; now it is {}. Continue it with that one, or "
                                  "begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The calibration of {} was valid until {}. Calibrate it again, or take another one."),
    QT_TRANSLATE_NOOP("Sentence", "{}{} is unknown; did you mean {}?"),
    QT_TRANSLATE_NOOP("Sentence", "{} is a number; write it in quotes, so that its zeros are kept."),
    QT_TRANSLATE_NOOP("Sentence", "{} has to be a text of at most {} characters in one line."),
    QT_TRANSLATE_NOOP("Sentence", "notes has to be a text of at most {} characters."),
    QT_TRANSLATE_NOOP("Sentence", "{} has to be a list of at most {} entries."),
    QT_TRANSLATE_NOOP("Sentence", "{}name is missing."),
    QT_TRANSLATE_NOOP("Sentence", "{}valid_until, {}, is before calibrated, {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} has to be a day such as 2026-03-01."),
    QT_TRANSLATE_NOOP("Sentence", "photos has to be a list of files with name and sha256."),
    QT_TRANSLATE_NOOP("Sentence", "photos has to be a list of at most {} paths."),
    QT_TRANSLATE_NOOP("Sentence", "equipment {}: it has {} parts between semicolons; allowed are name; serial number; "
                                  "calibrated; valid until."),
    QT_TRANSLATE_NOOP("Sentence", "required has to be a list of keys, such as [car_vin, operator]."),
    QT_TRANSLATE_NOOP("Sentence", "key_battery_v is no number; allowed is 0 to 60 V."),
    QT_TRANSLATE_NOOP("Sentence", "key_battery_v is {} V; allowed is 0 to 60 V."),
    QT_TRANSLATE_NOOP("Sentence", "There are {} photos; at most {} are kept with a test."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} is no photo; kept are {}."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} is no file of at most {} MiB."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} cannot be copied: {}."),
)
