"""A parameter that is one word of a few."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

from .errors import InvalidParameter


@dataclass(frozen=True)
class Choice:
    """One parameter that is a word of a few; it is called the same in files.

    default: what a file means that does not name it: one from before there was a choice. proposed: with what a person
    begins who chooses anew.
    """

    words: tuple[str, ...]
    default: str
    proposed: str
    doc: str

    @property
    def allowed(self) -> str:
        """The words, for a sentence."""
        return " or ".join(self.words)

    def checked(self, file_key: str, value: Any) -> str:
        """What stood in a file; InvalidParameter when it is none of the words."""
        if not isinstance(value, str) or value not in self.words:
            shown = value[:20] if isinstance(value, str) else f"no word ({type(value).__name__})"
            raise InvalidParameter(f"Parameter {file_key} is {shown}; allowed is {self.allowed}.")
        return value


def choice(words: tuple[str, ...], proposed: str, doc: str) -> Any:
    """Field of a ParameterSet; the first word is the default, see Choice."""
    return dataclasses.field(default=words[0], metadata={"choice": Choice(words, words[0], proposed, doc)})
