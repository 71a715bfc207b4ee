"""The checklist in the words of the language in use."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.station.checks import check_texts
from mtr_operator.station.checks.check_texts import Speech
from mtr_operator.station.checks.finding import Check, Item

from ..i18n import duration, number, translate
from ..names import domain_word
from ..sentences import translated

_OF_WINDOW = Speech(translate, translated, domain_word, number, duration)


def check_title(check: Check) -> str:
    """What is looked at."""
    return check_texts.check_title(check, _OF_WINDOW)


def check_text(item: Item) -> str:
    """What was found, in a sentence."""
    return check_texts.check_text(item, _OF_WINDOW)


def check_advice(item: Item) -> str:
    """What to do about it; empty where nothing is to be done, or the sentence says it already."""
    return check_texts.check_advice(item, _OF_WINDOW)


def condition_title(name: str) -> str:
    """An operating condition in a word or two."""
    return check_texts.condition_title(name, _OF_WINDOW)


def condition_text(name: str) -> str:
    """What an operating condition demands, as a question."""
    return check_texts.condition_text(name, _OF_WINDOW)
