"""Sentences on the distance of a phone that is the Car's key, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "position {} ({}, {} m)"),
    QT_TRANSLATE_NOOP("Sentence", "Nothing tells the phone's distance: the Car's profile declares no "
                                  "phone_distance; add one to the profile, or name a feed (--phone-feed)."),
    QT_TRANSLATE_NOOP("Sentence", "Nothing tells the phone's distance any more: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance was told {} times within {} s; {} times are needed."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance did not change within {} s; {} changes are needed. Increase "
                                  "reading_time_s, or check the phone."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance did not change more than once within {} s; {} changes are "
                                  "needed. Increase reading_time_s, or check the phone."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance did not change more than {} times within {} s; {} changes "
                                  "are needed. Increase reading_time_s, or check the phone."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distances scatter by {} m; their median is not known."),
    QT_TRANSLATE_NOOP("Sentence", "The clock of the phone's distance was set forward by {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The clock of the phone's distance was set back by {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The newest distance of the phone was {} s old while it was read; allowed are {} "
                                  "s."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance was {} m without any change at places {} and {} m away; "
                                  "the feed is frozen or at the end of its range."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance, {} m, is off by {} m; that is none."),
    QT_TRANSLATE_NOOP("Sentence", "The phone is at the reference itself."),
    QT_TRANSLATE_NOOP("Sentence", "The robot moved while the phone's distance was read."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not say how sure it is of its position."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance cannot be read from {}: {}; start what sends it, or "
                                  "correct the feed's address."),
    QT_TRANSLATE_NOOP("Sentence", "The phone's distance does not come from {} any more: {}."),
    QT_TRANSLATE_NOOP("Sentence", "What comes from {} is no distance: {}"),
    QT_TRANSLATE_NOOP("Sentence", "Nothing has come from {} since it was connected; see whether it sends a line "
                                  "for each distance."),
    QT_TRANSLATE_NOOP("Sentence", "The feed of the phone's distance is {}; allowed is {}."),
    QT_TRANSLATE_NOOP("Sentence", "The {} of the phone's feed is {}; allowed is {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "A simulated phone has no {}; allowed are {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} of a simulated phone is {}; allowed is a number."),
    QT_TRANSLATE_NOOP("Sentence", "nobody has answered for {} s"),
    QT_TRANSLATE_NOOP("Sentence", "it is not connected"),
    QT_TRANSLATE_NOOP("Sentence", "it is not open"),
    QT_TRANSLATE_NOOP("Sentence", "the other side has closed the connection"),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance must be tcp:HOST:PORT, serial:DEVICE:BAUD, or a "
                                  "table of {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance names the bus {}, which is not in buses."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance needs the entry database."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance names the signal {}, whose scale in the database "
                                  "is 0."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance has the unit {}; allowed is {}: name it (unit)."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance has no_distance: {}; allowed is a list of whole "
                                  "numbers."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: phone_distance is {}; a simulated phone is for the command line "
                                  "(--phone-feed)."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m is {} m; it has to be at most maximum_distance_m, "
                                  "{} m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter maximum_age_s is {} s; it has to be at most reading_time_s, {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Beside each distance that the phone told stands 1 sigma of where it really was, "
                                  "and the 95 % interval of what it told there; the errors are in results.csv."),
)

WORDS = (
    QT_TRANSLATE_NOOP("Word", "position"),
    QT_TRANSLATE_NOOP("Word", "phone"),
    QT_TRANSLATE_NOOP("Word", "Error"),
    QT_TRANSLATE_NOOP("Word", "No answer"),
    QT_TRANSLATE_NOOP("Word", "port"),
    QT_TRANSLATE_NOOP("Word", "baud rate"),
    QT_TRANSLATE_NOOP("Word", "bias"),
    QT_TRANSLATE_NOOP("Word", "spread of errors"),
    QT_TRANSLATE_NOOP("Word", "95 % of errors within"),
    QT_TRANSLATE_NOOP("Word", "places without answer"),
    QT_TRANSLATE_NOOP("Word", "phone's distance from"),
    QT_TRANSLATE_NOOP("Word", "distances of the phone that were not used"),
)

PARAMETERS = (
    QT_TRANSLATE_NOOP("ParameterDoc", "Nearest places at which the distance is read."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Farthest places at which the distance is read."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Standstill before the distance is read."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the distance is read at each place."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Minimum number of reported distances at a place, and of changes among "
                                      "them; at least 4 changes are needed in any case."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Longest time for which the newest reported distance may stand; a place "
                                      "where it is older is invalid."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Step of the reported distances."),
    QT_TRANSLATE_NOOP("ParameterDoc", "What the reported distance is compared with. outline: the shortest way from "
                                      "the phone to the Car's outline, over ground. anchor: the straight way to a "
                                      "point of the Car, with the difference in height."),
    QT_TRANSLATE_NOOP("ParameterDoc", "The anchor, ahead of the Car's centre."),
    QT_TRANSLATE_NOOP("ParameterDoc", "The anchor, to the left of the Car's centre."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Height of the anchor above ground."),
)
