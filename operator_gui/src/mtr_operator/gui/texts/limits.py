"""Sentences on limits files and calibration records, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "The file {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} {}."),
    QT_TRANSLATE_NOOP("Sentence", "In the file {}: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with other limits, or with none; continue it without this file, "
                                  "or begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with another calibration record of the robot; continue it "
                                  "without this file, or begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's calibration record of {} is {} days old; it was valid for {} days. "
                                  "Calibrate the robot again, or doubt the uncertainties."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's {} was measured {} days ago; it was valid for {} days. Calibrate the "
                                  "robot again."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter press_strength is {}; at the calibration of {} the Car answered from {} "
                                  "on. Press at least as strongly, or calibrate again."),
    QT_TRANSLATE_NOOP("Sentence", "There are {} readings; give at least {}."),
    QT_TRANSLATE_NOOP("Sentence", "There are {} readings to the front axle and {} to the rear one; give as many of "
                                  "both."),
    QT_TRANSLATE_NOOP("Sentence", "The readings differ by {} mm; allowed is {} mm. Read them again."),
    QT_TRANSLATE_NOOP("Sentence", "The distance between the axles differs by {} mm between the readings; allowed is {} "
                                  "mm. Read them again."),
    QT_TRANSLATE_NOOP("Sentence", "The heights are {} cm apart; give some that are at least {} cm apart."),
    QT_TRANSLATE_NOOP("Sentence", "checks has to be a list of at most {} entries."),
    QT_TRANSLATE_NOOP("Sentence", "valid_days has to be a whole number of days from 1 to 3650, or null."),
    QT_TRANSLATE_NOOP("Sentence", "{}distribution has to be one of {}."),
    QT_TRANSLATE_NOOP("Sentence", "{}it has to consist of lines of the form 'name: value'."),
    QT_TRANSLATE_NOOP("Sentence", "{}{} is missing."),
    QT_TRANSLATE_NOOP("Sentence", "{}{} is unknown; known are {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} has to be a text of 1 to {} characters in one line."),
    QT_TRANSLATE_NOOP("Sentence", "date has to be a day such as 2026-03-01."),
    QT_TRANSLATE_NOOP("Sentence", "It has to consist of lines of the form 'name: value', one of them 'limits:'."),
    QT_TRANSLATE_NOOP("Sentence", "'limits' has to be a list of 1 to {} limits."),
    QT_TRANSLATE_NOOP("Sentence", "Two limits are called {}; give each a name of its own."),
    QT_TRANSLATE_NOOP("Sentence", "{}it needs either at_least_m or at_most_m; or, of what is no distance, one of {}."),
    QT_TRANSLATE_NOOP("Sentence", "{}share_percent is for distances; leave it out beside {}."),
    QT_TRANSLATE_NOOP("Sentence", "{}share_percent has to be one of {}."),
    QT_TRANSLATE_NOOP("Sentence", "{}sides has to be a list of sides, such as [left, front_left]."),
    QT_TRANSLATE_NOOP("Sentence", "{}angles_deg has to be a list of two angles, such as [225, 315]."),
    QT_TRANSLATE_NOOP("Sentence", "{}angles_deg goes round more than once."),
    QT_TRANSLATE_NOOP("Sentence", "{}{} has to be a text of 1 to {} characters in one line."),
    QT_TRANSLATE_NOOP("Sentence", "{}side {} is unknown; known are {}."),
    QT_TRANSLATE_NOOP("Sentence", "{}{} is unknown; {}"),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: {} measures no {}; it measures {}."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: with these parameters {} does not say how sure a distance is; no limit "
                                  "can be judged."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: {} tells the distance for {} % of the attempts, not for {} %."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: it is at {} m, and the test measures from {} to {} m only; no measurement "
                                  "could judge it."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: it is at {} {}, and with these parameters only one from {} to {} {} can "
                                  "be judged."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {}: {} is limited by {}, not by {}."),
    QT_TRANSLATE_NOOP("Sentence", "Limit {} names no {} of this test."),
    QT_TRANSLATE_NOOP("Sentence", "Limits {} and {} contradict each other on {} {}: {}, {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} at least {} m for {} % of the attempts"),
    QT_TRANSLATE_NOOP("Sentence", "{} at most {} m for {} % of the attempts"),
    QT_TRANSLATE_NOOP("Sentence", "{} at most {} s"),
    QT_TRANSLATE_NOOP("Sentence", "{} at least {} s"),
    QT_TRANSLATE_NOOP("Sentence", "{} at most {} m"),
    QT_TRANSLATE_NOOP("Sentence", "{} at most {} %"),
    QT_TRANSLATE_NOOP("Sentence", "Wanted is {}; at {} m attempts failed again and again."),
    QT_TRANSLATE_NOOP("Sentence", "Wanted is {}; it {}."),
    QT_TRANSLATE_NOOP("Sentence", "Wanted is {}; it {}, which holds the limit."),
    QT_TRANSLATE_NOOP("Sentence", "is below {} m"),
    QT_TRANSLATE_NOOP("Sentence", "is above {} m"),
    QT_TRANSLATE_NOOP("Sentence", "lies between {} and {} m"),
    QT_TRANSLATE_NOOP("Sentence", "is below {} s"),
    QT_TRANSLATE_NOOP("Sentence", "is above {} s"),
    QT_TRANSLATE_NOOP("Sentence", "lies between {} and {} s"),
    QT_TRANSLATE_NOOP("Sentence", "lies between {} and {} %"),
    QT_TRANSLATE_NOOP("Sentence", "The line does not tell this."),
    QT_TRANSLATE_NOOP("Sentence", "The line was not measured."),
    QT_TRANSLATE_NOOP("Sentence", "The line does not tell this distance."),
    QT_TRANSLATE_NOOP("Sentence", "The measurement does not say how sure it is."),
    QT_TRANSLATE_NOOP("Sentence", "It was not reached, and the line does not tell on which side of the limit it lies."),
    QT_TRANSLATE_NOOP("Sentence", "The key worked nowhere in this test; it may have been asleep."),
    QT_TRANSLATE_NOOP("Sentence", "calibration record of {}: {}"),
)
