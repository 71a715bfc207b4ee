"""Sentences that come from below the window, in the language in use.

The domain and the links speak English, and know no Qt. texts/ lists their sentences with {} for what varies, which may
be a sentence of the robot, translated by its code. One that is not listed is shown as it is.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import re

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.parameters import KILOMETRES_PER_HOUR, ParameterSet, with_unit

from .i18n import ENGLISH, decimal_sign, language_code, translate
from .names import domain_word, parameter_title
from .robot_sentences import RobotSentences
from .texts import application, judgement

robot_sentences = RobotSentences()

# A number, with or without its unit.
_DECIMAL = re.compile(r"[+-]?\d+\.\d+( \S+)?")
_SPEED = re.compile(r"(\d+(?:\.\d+)?) m/s")


def translated(sentence: str) -> str:
    """The sentence in the language in use."""
    if not sentence or language_code() == ENGLISH:
        return sentence
    said = robot_sentences.translated(sentence, language_code())
    if said is not None:
        return said
    for template, pattern in _patterns():
        match = pattern.fullmatch(sentence)
        if match is not None:
            return translate("Sentence", template).format(*map(_value, match.groups()))
    return sentence


def parameter_sentence(error: InvalidParameter, parameters_type: type[ParameterSet]) -> str:
    """Why parameters do not fit together, in the names and units of the window instead of those of files."""
    return in_window_words(str(error), parameters_type)


def in_window_words(sentence: str, parameters_type: type[ParameterSet]) -> str:
    """A sentence on parameters, in the names and units of the window instead of those of files."""
    sentence = _SPEED.sub(_in_kilometres_per_hour, sentence)
    sentence = translated(sentence)
    # Longer names first: one may be the beginning of another.
    declarations = sorted(parameters_type.declarations().items(), key=lambda item: -len(item[1].file_key))
    for name, declared in declarations:
        title = parameter_title(name, declared)
        sentence = sentence.replace(
            declared.file_key, translate("Sentence", "“{title}”").format(title=title))
    return sentence


def _in_kilometres_per_hour(match: re.Match[str]) -> str:
    unit, per_si = KILOMETRES_PER_HOUR
    return with_unit(round(float(match[1]) * per_si, 3), unit)


def _value(text: str) -> str:
    """What varies may be a sentence, a word of the domain, or a number."""
    if _DECIMAL.fullmatch(text):
        return text.replace(".", decimal_sign())
    word = domain_word(text)
    return translated(text) if word == text else word


@functools.lru_cache(maxsize=1)
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    # The one with the most fixed text says most.
    templates = sorted(application.SENTENCES + judgement.SENTENCES, key=lambda text: -len(text.replace("{}", "")))
    return [(template, re.compile("(.+?)".join(map(re.escape, template.split("{}"))), re.DOTALL))
            for template in templates]
