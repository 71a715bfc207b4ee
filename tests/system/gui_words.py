"""What an English text of the window is called in another language, out of the catalogue of its translations."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import xml.etree.ElementTree
from typing import Dict, List, Optional

from mtr_operator.gui import i18n

# That a template says by itself: others fit anything.
MIN_LETTERS = 6
_PLACEHOLDER = re.compile(r"\{[a-z]*\}")


class Words:
    """Knows the texts of one language; a text that is in no catalogue stays as it is."""

    def __init__(self, path: pathlib.Path):
        self._texts: Dict[str, str] = {}
        for message in xml.etree.ElementTree.parse(str(path)).iter("message"):
            source, translation = message.findtext("source"), message.findtext("translation")
            if source and translation:
                self._texts.setdefault(source, translation)
        fixed = {source: len(_PLACEHOLDER.sub("", source)) for source in self._texts if _PLACEHOLDER.search(source)}
        self._templates = sorted((source for source, letters in fixed.items() if letters >= MIN_LETTERS),
                                 key=lambda source: -fixed[source])

    def of(self, text: str) -> str:
        """A whole text, or the beginning of one."""
        exact = self._texts.get(text)
        return exact or self._filled(text) or self._beginning(text) or self._filled(f"{text} x", " x") or text

    def _filled(self, text: str, tail: str = "") -> Optional[str]:
        """With what stands for the placeholders; tail: of the last one, to be taken away again."""
        for source in self._templates:
            match = re.fullmatch("(.+?)".join(map(re.escape, _PLACEHOLDER.split(source))), text)
            if match is None:
                continue
            values = dict(zip(_PLACEHOLDER.findall(source), map(self._value, match.groups())))
            found = _PLACEHOLDER.sub(lambda place, values=values: values.get(place.group(), ""), self._texts[source])
            return found[:len(found) - len(tail)] if tail else found
        return None

    def _value(self, value: str) -> str:
        return self._texts.get(value, value)

    def _beginning(self, text: str) -> Optional[str]:
        """As far as nothing varies."""
        found: List[str] = [translation for source, translation in self._texts.items() if source.startswith(text)]
        return _PLACEHOLDER.split(found[0])[0] or None if found else None


def words_of(language: str) -> Optional[Words]:
    """None for English, which the window is written in."""
    return None if language == i18n.ENGLISH else Words(i18n.FOLDER / f"mtr_operator_{language}.ts")
