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
    QT_TRANSLATE_NOOP("Sentence", "Localization has another map than the one in which the Car was found. {}"),
    QT_TRANSLATE_NOOP("Sentence", "Localization has another map than the one in which the Car was found."),
    QT_TRANSLATE_NOOP("Sentence", "The Car does not stand where it was measured."),
    QT_TRANSLATE_NOOP("Sentence", "Looks at the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "There is nothing of a Car's size where the Car should stand."),
    QT_TRANSLATE_NOOP("Sentence", "Not enough of a Car was seen: one long side and one end are needed at least, or "
                                  "all four wheels."),
    QT_TRANSLATE_NOOP("Sentence", "What stands there looks too little like a Car: {} % of a Car's outline was seen;"
                                  " its likeness is {}, needed is {}."),
    QT_TRANSLATE_NOOP("Sentence", "Only wheels of the Car were seen, and they do not stand as a car's do."),
    QT_TRANSLATE_NOOP("Sentence", "What was found is {} m and {} deg away from where the Car should stand; allowed "
                                  "is {} m and {} deg."),
    QT_TRANSLATE_NOOP("Sentence", "Two things of a Car's size stand there, {} m apart, and which of them is the Car"
                                  " cannot be told."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's long sides were seen too little to tell its heading."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was found: {} m long (1 sigma {} cm), {} m wide (1 sigma {} cm)."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was found by its wheels, {} m long (1 sigma {} cm), {} m wide (1 sigma "
                                  "{} cm); the LiDARs look under its bumpers. Known length and front overhang make "
                                  "it more exact."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was found by its wheels, {} m long (1 sigma {} cm), {} m wide (1 sigma "
                                  "{} cm); the LiDARs look under its bumpers."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's frame was corrected by {} cm and {} deg, as it is seen now; it has "
                                  "revision {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car is no longer seen where it was measured."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was moved, by {} cm and {} deg."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's position is lost. {} Put the robot at the starting place and map "
                                  "again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's pose is not known yet."),
    QT_TRANSLATE_NOOP("Sentence", "The Car stands {} cm and {} deg from where it was measured (1 sigma {} cm, {} "
                                  "deg)."),
    QT_TRANSLATE_NOOP("Sentence", "The Car stands {} cm and {} deg from where it was measured (1 sigma {} cm, {} "
                                  "deg); allowed is {} cm and {} deg. Close its doors and check again, or map it "
                                  "again."),
    QT_TRANSLATE_NOOP("Sentence", "The Car stands {} cm from where it was measured."),
    QT_TRANSLATE_NOOP("Sentence", "The Car stands {} cm from where it was measured; allowed is {} cm. Map it again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot goes to look at the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "The Car could be looked at from {} of {} places only; clear the way round it, or"
                                  " map it again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot makes a map of what it has seen."),
    QT_TRANSLATE_NOOP("Sentence", "Localization has not made its map within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Localization could not make a map of what was seen."),
    QT_TRANSLATE_NOOP("Sentence", "No way to the goal was found that keeps the robot away from the Car."),
    QT_TRANSLATE_NOOP("Sentence", "No way to the goal was found that keeps the robot away from the Car and inside "
                                  "the test area."),
    QT_TRANSLATE_NOOP("Sentence", "At the goal the robot would not be inside the test area."),
    QT_TRANSLATE_NOOP("Sentence", "The robot stands outside the test area; move it back by hand."),
    QT_TRANSLATE_NOOP("Sentence", "The robot is {} by an obstacle {} m {}."),
    QT_TRANSLATE_NOOP("Sentence", "The robot is {} by an obstacle."),
    QT_TRANSLATE_NOOP("Sentence", "The robot stands because a LiDAR that should see its way is silent."),
    QT_TRANSLATE_NOOP("Sentence", "The press was cut short; it may have pressed or not."),
    QT_TRANSLATE_NOOP("Sentence", "Stand still: measuring the gyro's bias."),
    QT_TRANSLATE_NOOP("Sentence", "Waiting for wheel odometry."),
    QT_TRANSLATE_NOOP("Sentence", "Wheel odometry is silent, or its stamps are old."),
    QT_TRANSLATE_NOOP("Sentence", "Wheel odometry is not a finite number."),
    QT_TRANSLATE_NOOP("Sentence", "Wheel odometry was silent for {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Wheel odometry jumped by {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Waiting for the IMU."),
    QT_TRANSLATE_NOOP("Sentence", "The IMU is silent."),
    QT_TRANSLATE_NOOP("Sentence", "The IMU was silent for {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The IMU's rate is not a number."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: {} Map the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: {} Searching near the last position."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: the LiDAR does not see what the map shows here. Searching near "
                                  "the last position."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: the LiDAR does not see what it saw on the way. Unless it does "
                                  "again, map the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: nothing of the map has been in view for too long. Searching near "
                                  "the last position."),
    QT_TRANSLATE_NOOP("Sentence", "Position lost: by satellites the robot is {} m from there. Searching near the "
                                  "last position."),
    QT_TRANSLATE_NOOP("Sentence", "There is no transform from {} to '{}'. The satellite receiver is not used."),
    QT_TRANSLATE_NOOP("Sentence", "Its fixes are none, or they do not say that they are within 5 m (1 sigma). The "
                                  "satellite receiver is not used."),
    QT_TRANSLATE_NOOP("Sentence", "The key-frames gave no map. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The position was lost on the way round the Car, and the robot went on; map the "
                                  "Car again."),
    QT_TRANSLATE_NOOP("Sentence", "Only {} key-frames were taken, {} are needed: drive round the Car."),
    QT_TRANSLATE_NOOP("Sentence", "The way round the Car was not closed: it must end within {} m of where it "
                                  "passed before."),
    QT_TRANSLATE_NOOP("Sentence", "What the LiDARs saw from different places disagrees by {} times its uncertainty."),
    QT_TRANSLATE_NOOP("Sentence", "Wheels and gyro disagree with the LiDARs by {} times their uncertainty."),
    QT_TRANSLATE_NOOP("Sentence", "The Car is {} m {} at the LiDARs' height, {} cm {} than its data sheet says; "
                                  "check which car stands there."),
    QT_TRANSLATE_NOOP("Sentence", "The lift is not calibrated while an application or the manual controller is in "
                                  "control."),
    QT_TRANSLATE_NOOP("Sentence", "The calibration of the lift was ended: calibrate_lift is silent."),
)
