"""What the domain calls by names in files, in words of the Operator; what is not listed follows from its name."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.choice import Choice
from mtr_operator.domain.parameters import Declaration, Flag
from mtr_operator.domain.scenario import AnyScenario

from .i18n import translate

_SUFFIXES = ("_m", "_mps", "_s", "_rad", "_deg")


def parameter_title(name: str, declared: Declaration) -> str:
    """Label of a parameter's field; the words are those of the thesis where it has some."""
    titles = {
        "minimum_distance_m": translate("Parameter", "Minimum distance"),
        "maximum_distance_m": translate("Parameter", "Starting distance"),
        "straightening_distance_m": translate("Parameter", "Straightening distance"),
        "measurements_distance_m": translate("Parameter", "Measurements distance"),
        "approach_distance_m": translate("Parameter", "Approach distance"),
        "angle_between_radials_rad": translate("Parameter", "Degrees between radials"),
        "key_height_m": translate("Parameter", "Device height"),
        "maximum_speed_mps": translate("Parameter", "Maximum speed"),
        "measuring_speed_mps": translate("Parameter", "Measuring speed"),
        "passes": translate("Parameter", "Passes"),
        "measuring_speeds_mps": translate("Parameter", "Speeds of the passes"),
        "boundary_sigma_m": translate("Parameter", "Sigma of the boundary"),
        "last_step_m": translate("Parameter", "Step of a last approach"),
        "clearance_m": translate("Parameter", "Clearance"),
        "response_timeout_s": translate("Parameter", "Response time"),
        "lock_timeout_s": translate("Parameter", "Locking time"),
        "press_strength": translate("Parameter", "Press strength"),
        "press_duration_s": translate("Parameter", "Press duration"),
        "settle_time_s": translate("Parameter", "Standstill before a press"),
        "attempts": translate("Parameter", "Attempts"),
        "interval_m": translate("Parameter", "Interval wanted, half width"),
        "border_distance_m": translate("Parameter", "Nominal border"),
        "border_requests": translate("Parameter", "Requests at the border"),
        "handle_timeout_s": translate("Parameter", "Time for the Operator"),
        "heights": translate("Parameter", "Heights"),
        "highest_key_height_m": translate("Parameter", "Highest device height"),
        "half_wavelength_m": translate("Parameter", "Half a wavelength"),
        "attempts_limit": translate("Parameter", "Presses at most"),
        "confirming_presses": translate("Parameter", "Presses that confirm"),
        "key_frequency_hz": translate("Parameter", "Key's radio frequency"),
        "key_rest_limit_s": translate("Parameter", "Key's rest at most"),
        "lateral_tolerance_m": translate("Parameter", "Distance beside the line"),
        "heading_tolerance_rad": translate("Parameter", "Turn from the line"),
        "height_tolerance_m": translate("Parameter", "Difference in height"),
        "speed_tolerance_mps": translate("Parameter", "Difference in speed"),
    }
    return titles.get(name) or plain_words(name, declared)


def plain_words(name: str, declared: Declaration) -> str:
    """Words of a parameter of a scenario that came later."""
    for suffix in _SUFFIXES:
        if declared.unit and name.endswith(suffix):
            name = name[:-len(suffix)]
            break
    return name.replace("_", " ").capitalize()


def flag_title(name: str) -> str:
    """Label of the check box of a parameter that is true or false."""
    titles = {"self_check": translate("Parameter", "Check the Car's position before the test")}
    return titles.get(name) or name.replace("_", " ").capitalize()


def choice_title(name: str) -> str:
    """Label of the choice of a parameter that is a word."""
    titles = {"method": translate("Parameter", "Method"), "side": translate("Parameter", "Side of the Car"),
              "relock": translate("Parameter", "Locking the Car again")}
    return titles.get(name) or name.replace("_", " ").capitalize()


def choice_word(word: str) -> str:
    """One of the words to choose from."""
    words = {"scan": translate("Parameter", "from far to near (scan)"),
             "adaptive": translate("Parameter", "search with intervals (adaptive)"),
             "all": translate("Parameter", "all around"), "button": translate("Parameter", "by the key's button"),
             "itself": translate("Parameter", "the Car by itself")}
    return words.get(word) or domain_word(word.replace("_", " "))


def yes_or_no(value: bool) -> str:
    """Value of such a parameter."""
    return translate("Parameter", "yes") if value else translate("Parameter", "no")


def parameter_doc(declared: Declaration | Flag | Choice) -> str:
    """Tool tip of a parameter's field."""
    return translate("ParameterDoc", declared.doc)


def scenario_title(scenario: AnyScenario) -> str:
    """Name of a scenario."""
    return translate("Scenario", scenario.title)


def scenario_doc(scenario: AnyScenario) -> str:
    """One sentence on a scenario."""
    return translate("Scenario", " ".join((type(scenario).__doc__ or "").split()))


def domain_word(word: str) -> str:
    """Translation of one of the domain's words: "axis", "unlock", "not reached", "front left"."""
    return translate("Word", word)
