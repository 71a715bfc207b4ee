"""Why a line is invalid: what the Car's locks, the robot's place and its interventions say against it."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "A frame of the Car's lock message came {} s after a later one."),
    QT_TRANSLATE_NOOP("Sentence", "A frame of the Car's lock message came twice."),
    QT_TRANSLATE_NOOP("Sentence", "The signal {} of the Car's lock message stands still at {}."),
    QT_TRANSLATE_NOOP("Sentence", "The signal {} of the Car's lock message went from {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "The signal {} of the Car's lock message has the unknown value {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} on its bus, and {} counted no command."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} on its bus, and {} said nothing of a change."),
    QT_TRANSLATE_NOOP("Sentence", "{} told of a change, and the Car stayed {} on its bus."),
    QT_TRANSLATE_NOOP("Sentence", "The Car changed its locks on its bus after {} s; a state lasts at least {} s and {} "
                                  "frames."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody knows when the Car's locks moved: the clocks were set anew."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} without anything in the test to make it; leave its keys and doors "
                                  "alone during the test."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} twice, without the opposite in between."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} {} s before {}, by something else; leave its keys and doors alone "
                                  "during the test."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} {} s too late for {}; increase response_timeout_s if it is so "
                                  "slow."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} when it locks by itself anyway, so that nobody knows whether it was "
                                  "by {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} by the button of a key, not by {}; leave the keys alone during the "
                                  "test."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} by the vicinity of a key, not by {}; switch passive entry off, or "
                                  "increase minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} by something that its profile does not list, not by {}; leave its "
                                  "doors and switches alone during the test."),
    QT_TRANSLATE_NOOP("Sentence", "the press at {} m"),
    QT_TRANSLATE_NOOP("Sentence", "the Remote key's vicinity"),
    QT_TRANSLATE_NOOP("Sentence", "No press worked, and none of {} at {} m either: the key sleeps, its battery is "
                                  "empty, or the Car's range ends nearer; then decrease minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "The Car reacted at {} m, where the robot was not to be: the line reaches from {} to "
                                  "{} m."),
    QT_TRANSLATE_NOOP("Sentence", "The robot was too fast for a measurement: {} m/s; allowed is {} m/s."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not know the height of the Remote key."),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key is at {} cm instead of {} cm; allowed are {} cm of difference."),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key was {} cm beside the line; allowed are {} cm."),
    QT_TRANSLATE_NOOP("Sentence", "The robot was turned by {} degrees from the line; allowed are {} degrees."),
    QT_TRANSLATE_NOOP("Sentence", "The robot was driven by hand during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key was moved by hand during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "The robot planned its path anew during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "An obstacle, or sensors that saw nothing, stopped the robot during the "
                                  "measurement."),
    QT_TRANSLATE_NOOP("Sentence", "A motion lock stopped the robot during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "The board of lift and servos restarted during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's clock was set during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "more than one boundary; the interval reaches from the nearest to the farthest"),
    QT_TRANSLATE_NOOP("Sentence", "more than one boundary, a hole from {} to {} m; the interval reaches from the "
                                  "nearest boundary to the farthest"),
    QT_TRANSLATE_NOOP("Sentence", "more than one boundary, a hole up to {} m; the interval reaches from the nearest "
                                  "boundary to the farthest"),
    QT_TRANSLATE_NOOP("Sentence", "The last estimate, with all lines, has wider 95 % intervals: {}."),
)
