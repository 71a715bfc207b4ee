"""Sentences of the robot in another language, by their codes: translations/robot_<language>.yaml has a template each.

The application hands on what the robot says as text: within sentences of its own, in results, to files. So the window
remembers by which code and arguments each text came over the link. A text that came without them, from a robot of
before or out of a file, stays English.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import functools
import re
from dataclasses import dataclass
from typing import Iterable, Mapping, Sequence

import yaml

from mtr_operator.domain.robot_status import Problem

from .i18n import FOLDER, decimal_sign

# A test of two hours says a few hundred different sentences; their figures differ.
MAX_KNOWN = 10_000
_NUMBER = re.compile(r"[+-]?\d+\.\d+")


@dataclass(frozen=True)
class Table:
    """One language. sentences: code to template with named placeholders; words: what a placeholder may hold."""

    sentences: Mapping[str, str]
    words: Mapping[str, str]

    def text(self, problems: Sequence[Problem]) -> str:
        """The first problem in this language, followed in the sequence by its causes."""
        problem, *causes = problems
        template = self.sentences.get(problem.code)
        if template is None:
            return problem.text
        values = {name: self._value(value) for name, value in problem.arguments}
        if causes:
            values["cause"] = self.text(causes)
        try:
            return template.format(**values)
        except KeyError:  # the robot's software is of another version, whose sentence has other placeholders
            return problem.text

    def _value(self, value: str) -> str:
        if _NUMBER.fullmatch(value):
            return value.replace(".", decimal_sign())
        return self.words.get(value, value)


@functools.lru_cache(maxsize=None)
def table_of(language: str) -> Table:
    """Table of a language by its code; an empty one for English."""
    path = FOLDER / f"robot_{language}.yaml"
    if not path.is_file():
        return Table({}, {})
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    return Table(content["sentences"], content["words"])


class RobotSentences:
    """Remembers what the robot has said."""

    def __init__(self) -> None:
        self._known: collections.OrderedDict[str, Sequence[Problem]] = collections.OrderedDict()

    def learn(self, said: Iterable[Sequence[Problem]]) -> None:
        """Remember sentences, each with its causes."""
        for problems in said:
            self._known[problems[0].text] = problems
            self._known.move_to_end(problems[0].text)
        while len(self._known) > MAX_KNOWN:
            self._known.popitem(last=False)

    def translated(self, text: str, language: str) -> str | None:
        """What the robot has said with this text; None when it has not said it."""
        problems = self._known.get(text)
        return None if problems is None else table_of(language).text(problems)
