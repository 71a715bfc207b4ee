"""Messages of the Car locator to the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

# Progress
POSE_UNKNOWN = Sentence("car_locator.pose_unknown", "The robot's pose is not known yet.")
FIRST_LOOK = Sentence("car_locator.first_look", "The robot looks at the Car from where it stands.")
GOES_ROUND = Sentence("car_locator.goes_round", "The robot goes round the Car: place {place} of {total}.")
MAKES_MAP = Sentence("car_locator.makes_map", "The robot makes a map of what it has seen.")

# Located
FOUND = Sentence(
    "car_locator.found",
    "The Car was found: {length_m:.2f} m long (1 sigma {length_sigma_cm:.1f} cm), {width_m:.2f} m wide (1 sigma "
    "{width_sigma_cm:.1f} cm).")
FOUND_BY_WHEELS = Sentence(
    "car_locator.found_by_wheels",
    "The Car was found by its wheels, {length_m:.2f} m long (1 sigma {length_sigma_cm:.1f} cm), {width_m:.2f} m wide "
    "(1 sigma {width_sigma_cm:.1f} cm); the LiDARs look under its bumpers.")
FOUND_BY_WHEELS_ALONE = Sentence(
    "car_locator.found_by_wheels_alone",
    "The Car was found by its wheels, {length_m:.2f} m long (1 sigma {length_sigma_cm:.1f} cm), {width_m:.2f} m wide "
    "(1 sigma {width_sigma_cm:.1f} cm); the LiDARs look under its bumpers. Known length and front overhang make it "
    "more exact.")
CORRECTED = Sentence(
    "car_locator.corrected",
    "The Car's frame was corrected by {shift_cm:.1f} cm and {turn_deg:.2f} deg, as it is seen now; it has revision "
    "{revision}.")

SHEET_CONTRADICTED = Sentence(
    "car_locator.sheet_contradicted",
    "{cause} Its data sheet is contradicted: {details} No test begins like this: enter the measures of the Car that "
    "stands there (car_file), restart the robot and map again.")

# Not located, or lost
NOT_FOUND = Sentence("car_locator.not_found",
                     "The Car was not found. {cause} Put the robot at the starting place and map again.")
LOST = Sentence("car_locator.lost",
                "The Car's position is lost. {cause} Put the robot at the starting place and map again.")
NOTHING_THERE = Sentence("car_locator.nothing_there",
                         "There is nothing of a Car's size where the Car should stand.")
TOO_LITTLE_SEEN = Sentence(
    "car_locator.too_little_seen",
    "Not enough of a Car was seen: one long side and one end are needed at least, or all four wheels.")
UNLIKE = Sentence(
    "car_locator.unlike",
    "What stands there looks too little like a Car: {cover_percent:.0f} % of a Car's outline was seen; its likeness is "
    "{likeness:.2f}, needed is {low}.")
TWO_CARS = Sentence(
    "car_locator.two_cars",
    "Two things of a Car's size stand there, {apart_m:.1f} m apart, and which of them is the Car cannot be told.")
HEADING_UNSEEN = Sentence("car_locator.heading_unseen",
                          "The Car's long sides were seen too little to tell its heading.")
WHEELS_APART = Sentence("car_locator.wheels_apart",
                        "Only wheels of the Car were seen, and they do not stand as a car's do.")
OTHER_SIZE = Sentence(
    "car_locator.other_size",
    "What was found has a {dimension} of {found_m:.2f} m; expected is {expected_m:.2f} m, at most {allowed_m:.2f} m "
    "off.")
ELSEWHERE = Sentence(
    "car_locator.elsewhere",
    "What was found is {off_m:.2f} m and {off_deg:.0f} deg away from where the Car should stand; allowed is "
    "{allowed_m:.2f} m and {allowed_deg:.0f} deg.")
NOT_A_NUMBER = Sentence("car_locator.not_a_number", "The fit of the Car is not a number.")
NO_MAP = Sentence("car_locator.no_map", "Localization could not make a map of what was seen.")
MAP_LATE = Sentence("car_locator.map_late", "Localization has not made its map within {limit_s} s.")
MAP_DAMAGED = Sentence("car_locator.map_damaged", "Localization's map of surfaces is damaged.")
OTHER_MAP = Sentence("car_locator.other_map",
                     "Localization has another map than the one in which the Car was found.")
GONE = Sentence("car_locator.gone", "The Car is no longer seen where it was measured.")
MOVED = Sentence("car_locator.moved", "The Car was moved, by {shift_cm:.1f} cm and {turn_deg:.2f} deg.")

# Self-check
CHECK_RUNNING = Sentence("car_locator.check_running", "The robot goes to look at the Car again.")
CHECK_BLOCKED = Sentence(
    "car_locator.check_blocked",
    "The Car could be looked at from {seen} of {needed} places only; clear the way round it, or map it again.")
CHECK_PASSED = Sentence(
    "car_locator.check_passed",
    "The Car stands {shift_cm:.1f} cm and {turn_deg:.2f} deg from where it was measured (1 sigma {shift_sigma_cm:.1f} "
    "cm, {turn_sigma_deg:.2f} deg).")
CHECK_FAILED = Sentence(
    "car_locator.check_failed",
    "The Car stands {shift_cm:.1f} cm and {turn_deg:.2f} deg from where it was measured (1 sigma {shift_sigma_cm:.1f} "
    "cm, {turn_sigma_deg:.2f} deg); allowed is {allowed_cm:.1f} cm and {allowed_deg:.2f} deg. Close its doors and "
    "check again, or map it again.")
