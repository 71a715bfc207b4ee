"""What the domain calls by names in files, in words of the Operator; what is not listed follows from its name."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.choice import Choice
from mtr_operator.domain.parameters import Declaration, Flag
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.report.parameter_names import parameter_name

from .i18n import translate


def parameter_title(name: str, declared: Declaration) -> str:
    """Label of a parameter's field."""
    return translate("Parameter", parameter_name(name, declared))


def flag_title(name: str) -> str:
    """Label of the check box of a parameter that is true or false."""
    titles = {"self_check": translate("Parameter", "Check the Car's position before the test")}
    return titles.get(name) or name.replace("_", " ").capitalize()


def choice_title(name: str) -> str:
    """Label of the choice of a parameter that is a word."""
    titles = {"method": translate("Parameter", "Method"), "side": translate("Parameter", "Side of the Car"),
              "relock": translate("Parameter", "Locking the Car again"),
              "reference": translate("Parameter", "Compared with")}
    return titles.get(name) or name.replace("_", " ").capitalize()


def choice_word(word: str) -> str:
    """One of the words to choose from."""
    words = {"scan": translate("Parameter", "from far to near (scan)"),
             "adaptive": translate("Parameter", "search with intervals (adaptive)"),
             "all": translate("Parameter", "all around"), "button": translate("Parameter", "by the key's button"),
             "itself": translate("Parameter", "the Car by itself"),
             "outline": translate("Parameter", "the way to the Car's outline"),
             "anchor": translate("Parameter", "the way to an anchor")}
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


def locks_text(locks: LockState) -> str:
    """State of the Car's locks."""
    return {LockState.LOCKED: translate("Locks", "locked"), LockState.UNLOCKED: translate("Locks", "unlocked"),
            LockState.UNKNOWN: translate("Locks", "not known")}[locks]


def identity_title(title: str) -> str:
    """Name of a part of a test's identity, see domain/identity."""
    return translate("Identity", title)


def domain_word(word: str) -> str:
    """Translation of one of the domain's words: "axis", "unlock", "not reached", "front left"."""
    return translate("Word", word)
