"""Sentences of the robot, with {} for what varies; one that is not listed is shown in English."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "No application controls the robot."),
    QT_TRANSLATE_NOOP("Sentence", "The application has been silent for more than {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Command refused: {}"),
    QT_TRANSLATE_NOOP("Sentence", "Command {} was refused: {}"),
    QT_TRANSLATE_NOOP("Sentence", "Application {} controls the robot; Commands of application {} are ignored."),
    QT_TRANSLATE_NOOP("Sentence", "The Operator stopped the robot."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's state machine is silent; the robot stands still."),
    QT_TRANSLATE_NOOP("Sentence", "The node of lift and buttons is silent."),
    QT_TRANSLATE_NOOP("Sentence", "The battery is at {} %."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not know its position."),
    QT_TRANSLATE_NOOP("Sentence", "Localization is lost. {}"),
    QT_TRANSLATE_NOOP("Sentence", "Localization is lost."),
    QT_TRANSLATE_NOOP("Sentence", "The position of the Car is no longer known; order the robot to map the Car "
                                  "again."),
    QT_TRANSLATE_NOOP("Sentence", "Waits for the first waypoint to map the Car."),
    QT_TRANSLATE_NOOP("Sentence", "The {} has not reported yet."),
    QT_TRANSLATE_NOOP("Sentence", "The {} has been silent for {} s."),
    QT_TRANSLATE_NOOP("Sentence", "There is nothing of a Car's size where the Car should stand; check the starting "
                                  "place."),
    QT_TRANSLATE_NOOP("Sentence", "Not enough of the Car was seen: one long side and one end are needed at least."),
    QT_TRANSLATE_NOOP("Sentence", "What was found is {} m away from where the Car should stand; allowed is {} m."),
    QT_TRANSLATE_NOOP("Sentence", "What was found has a {} of {} m; expected is {} m, at most {} m off."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was found: {} m long, {} m wide."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was not found. {} Put the robot at the starting place and map again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot goes round the Car: place {} of {}."),
    QT_TRANSLATE_NOOP("Sentence", "The robot looks at the Car from where it stands."),
    QT_TRANSLATE_NOOP("Sentence", "The robot stands before it touches the Car."),
    QT_TRANSLATE_NOOP("Sentence", "The robot is told to drive and does not move."),
    QT_TRANSLATE_NOOP("Sentence", "The robot stands so close to the Car that it cannot drive straight out; move it "
                                  "by hand."),
    QT_TRANSLATE_NOOP("Sentence", "At the goal the robot would leave {} m to the Car; at least {} m must be left."),
    QT_TRANSLATE_NOOP("Sentence", "The robot stands too close to the Car to plan; move it away by hand."),
    QT_TRANSLATE_NOOP("Sentence", "No straight piece leads to the goal past the Car without getting too close to "
                                  "it."),
    QT_TRANSLATE_NOOP("Sentence", "After {} corrections the robot stands {} m and {} deg off its goal."),
    QT_TRANSLATE_NOOP("Sentence", "Key height {} m was refused; allowed is {} to {} m."),
    QT_TRANSLATE_NOOP("Sentence", "A press without a button was refused."),
    QT_TRANSLATE_NOOP("Sentence", "Strength {} was refused; allowed is {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "Duration {} s was refused; allowed is above 0 to {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Button {} was refused; this key's mount has servos for {}."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware of lift and buttons has not reported yet."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware of lift and buttons is silent."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware of lift and buttons has been silent for {} s; check cable and "
                                  "power."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware reports fault {}."),
    QT_TRANSLATE_NOOP("Sentence", "The lift is jammed."),
    QT_TRANSLATE_NOOP("Sentence", "The position sensor of the lift is broken."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware hears no commands."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware did not report the press as done in time."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware started again during the press."),
    QT_TRANSLATE_NOOP("Sentence", "The firmware refused the press."),
    QT_TRANSLATE_NOOP("Sentence", "The waypoint ({} m, {} m) is too close to the Car."),
    QT_TRANSLATE_NOOP("Sentence", "The waypoint is not a number."),
)
