"""Elements and numbers of SDF texts."""
# SPDX-License-Identifier: Apache-2.0
from typing import Iterable, Union
from xml.etree.ElementTree import Element, SubElement

Value = Union[str, float, Iterable[float]]


def add(parent: Element, tag: str, value: Value = "", **attributes: str) -> Element:
    """Add a child with a text, a number or a list of numbers."""
    child = SubElement(parent, tag, attributes)
    child.text = text_of(value) or None
    return child


def text_of(value: Value) -> str:
    """Format numbers without loss, and truth values as words."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    numbers = [value] if isinstance(value, (int, float)) else value
    return " ".join(repr(int(each) if each == int(each) and abs(each) < 1e15 else float(each)) for each in numbers)
