"""Sentences of the motion planner for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

# Inputs that must not move the robot
INPUT_MISSING = Sentence("motion_planner.input_missing", "No {what} has arrived yet.")
INPUT_OLD = Sentence("motion_planner.input_old", "The newest {what} is {age_s:.2f} s old; allowed is {limit_s} s.")
INPUT_IN_FUTURE = Sentence(
    "motion_planner.input_in_future",
    "The newest {what} is {ahead_s:.2f} s in the future; allowed is {limit_s} s. Check the clocks.")
POSITION_UNKNOWN = Sentence("motion_planner.position_unknown",
                            "The robot does not know where it is: localization gave no reason.")
POSITION_UNKNOWN_BECAUSE = Sentence("motion_planner.position_unknown_because",
                                    "The robot does not know where it is: {cause}")
POSE_NOT_A_NUMBER = Sentence("motion_planner.pose_not_a_number", "The robot's pose is not a number.")
CAR_NOT_A_NUMBER = Sentence("motion_planner.car_not_a_number", "The Car's position is not a number.")
MAXIMUM_SPEED = Sentence("motion_planner.maximum_speed",
                         "The maximum speed is {value} m/s; it must be above 0 and at most {high} m/s.")

# Goals without a plan
GOAL_FRAME = Sentence("motion_planner.goal_frame", "The goal's frame is {frame}; allowed are car and map.")
GOAL_NOT_A_NUMBER = Sentence("motion_planner.goal_not_a_number", "The goal is not a number.")
CAR_NOT_LOCATED = Sentence("motion_planner.car_not_located",
                           "The Car has not been located, so a goal relative to it means nothing yet.")
OUTLINE_UNKNOWN = Sentence("motion_planner.outline_unknown",
                           "The Car's outline is unknown, so there is no way around it.")
OUTLINE_WITHOUT_SIZE = Sentence("motion_planner.outline_without_size", "The Car's outline has no size.")
OUTLINE_CROSSED = Sentence("motion_planner.outline_crossed", "The Car's outline crosses itself.")
GOAL_TOO_CLOSE = Sentence(
    "motion_planner.goal_too_close",
    "At the goal the robot would leave {left_m:.2f} m to the Car; at least {low_m:.2f} m must be left.")
FRONT_UNCERTAIN = Sentence(
    "motion_planner.front_uncertain",
    "Goal {left_m:.2f} m from a front known to {sigma_m:.2f} m: {low_m:.2f} m required. Enter data sheet or tape "
    "measurement (car_file), or measure farther away.")
REAR_UNCERTAIN = Sentence(
    "motion_planner.rear_uncertain",
    "Goal {left_m:.2f} m from a rear known to {sigma_m:.2f} m: {low_m:.2f} m required. Enter data sheet or tape "
    "measurement (car_file), or measure farther away.")
SIDE_UNCERTAIN = Sentence(
    "motion_planner.side_uncertain",
    "Goal {left_m:.2f} m from a side known to {sigma_m:.2f} m: {low_m:.2f} m required. Enter data sheet or tape "
    "measurement (car_file), or measure farther away.")
OWN_POSITION_UNCERTAIN = Sentence(
    "motion_planner.own_position_uncertain",
    "The robot knows its position to {sigma_m:.2f} m only: {left_m:.2f} m to the Car are too few. Drive it where it "
    "sees more, or map again.")
ROBOT_TOO_CLOSE = Sentence("motion_planner.robot_too_close",
                           "The robot stands too close to the Car to plan; move it away by hand.")
HEMMED_IN = Sentence(
    "motion_planner.hemmed_in",
    "The robot stands so close to the Car that it cannot drive straight out; move it by hand.")
GOAL_OUTSIDE = Sentence("motion_planner.goal_outside", "At the goal the robot would not be inside the test area.")
ROBOT_OUTSIDE = Sentence("motion_planner.robot_outside",
                         "The robot stands outside the test area; move it back by hand.")
NO_STRAIGHT_PIECE = Sentence(
    "motion_planner.no_straight_piece",
    "No straight piece leads to the goal past the Car without getting too close to it.")
NO_WAY = Sentence("motion_planner.no_way", "No way to the goal was found that keeps the robot away from the Car.")
NO_WAY_INSIDE = Sentence(
    "motion_planner.no_way_inside",
    "No way to the goal was found that keeps the robot away from the Car and inside the test area.")
PLANNING_DEFECT = Sentence(
    "motion_planner.planning_defect",
    "No plan was made for a defect of the planner ({what}); give another waypoint and send us the robot's log.")

# On the way
OFF_GOAL = Sentence(
    "motion_planner.off_goal",
    "After {corrections} corrections the robot stands {distance_m:.2f} m and {turn_deg:.1f} deg off its goal.")
BEFORE_CAR = Sentence("motion_planner.before_car", "The robot stands before it touches the Car.")
STALLED = Sentence("motion_planner.stalled", "The robot is told to drive and does not move.")
LIDAR_SILENT = Sentence("motion_planner.lidar_silent",
                        "The robot stands because a LiDAR that should see its way is silent.")
OBSTACLE = Sentence("motion_planner.obstacle", "The robot is {what} by an obstacle.")
OBSTACLE_AT = Sentence("motion_planner.obstacle_at", "The robot is {what} by an obstacle {distance_m:.1f} m {side}.")
