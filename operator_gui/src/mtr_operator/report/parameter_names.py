"""Names of parameters for people, equal in window, protocol and command line; files contain the keys.

The terms are from the thesis, except for the Remote key, which it also calls the device.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.parameters import Declaration

_SUFFIXES = ("_m", "_mps", "_s", "_rad", "_deg")
NAMES = {
    "minimum_distance_m": "Minimum distance",
    "maximum_distance_m": "Starting distance",
    "straightening_distance_m": "Straightening distance",
    "measurements_distance_m": "Measurements distance",
    "approach_distance_m": "Approach distance",
    "angle_between_radials_rad": "Degrees between radials",
    "key_height_m": "Key height",
    "maximum_speed_mps": "Maximum speed",
    "measuring_speed_mps": "Measuring speed",
    "passes": "Passes",
    "measuring_speeds_mps": "Speeds of the passes",
    "boundary_sigma_m": "Sigma of the boundary",
    "last_step_m": "Step of a last approach",
    "clearance_m": "Clearance",
    "spacing_m": "Distance between places",
    "coverage_percent": "Coverage wanted, half width",
    "presses_limit": "Presses in a zone at most",
    "response_timeout_s": "Response time",
    "lock_timeout_s": "Locking time",
    "press_strength": "Press strength",
    "press_duration_s": "Press duration",
    "settle_time_s": "Standstill before a press",
    "attempts": "Attempts",
    "interval_m": "Interval wanted, half width",
    "border_distance_m": "Nominal border",
    "border_requests": "Requests at the border",
    "handle_timeout_s": "Time for the Operator",
    "heights": "Heights",
    "highest_key_height_m": "Highest key height",
    "half_wavelength_m": "Half a wavelength",
    "attempts_limit": "Presses at most",
    "confirming_presses": "Presses that confirm",
    "key_frequency_hz": "Key's radio frequency",
    "key_rest_limit_s": "Key's rest at most",
    "stand_time_s": "Standstill before a reading",
    "reading_time_s": "Reading time",
    "minimum_samples": "Distances at least",
    "maximum_age_s": "Age at most",
    "resolution_m": "Step of the distances",
    "anchor_x_m": "Anchor ahead of the centre",
    "anchor_y_m": "Anchor to the left",
    "anchor_height_m": "Anchor height",
    "shortest_wait_s": "Shortest rest",
    "longest_wait_s": "Longest rest",
    "interval_s": "Time left open",
    "confirmations": "Trials that confirm",
    "requests": "Requests to a silent key",
    "trials_limit": "Trials at most",
    "wake_move_m": "Way that wakes the key",
    "places_m": "Places beyond the border",
    "requests_per_place": "Requests at each place",
    "switch_timeout_s": "Time to switch",
    "lateral_tolerance_m": "Distance beside the line",
    "heading_tolerance_rad": "Turn from the line",
    "height_tolerance_m": "Difference in height",
    "speed_tolerance_mps": "Difference in speed",
}


def parameter_name(name: str, declared: Declaration) -> str:
    """Return the name of a parameter from the name of its field."""
    return NAMES.get(name) or _plain_words(name, declared)


def _plain_words(name: str, declared: Declaration) -> str:
    """Return a name for a parameter that is missing in the table."""
    for suffix in _SUFFIXES:
        if declared.unit and name.endswith(suffix):
            name = name[:-len(suffix)]
            break
    return name.replace("_", " ").capitalize()
