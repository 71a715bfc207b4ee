"""YAML from outside: small, without what YAML can do beyond lines of names and values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import re
from typing import Any

import yaml

# A parameter file has some twenty lines, a car's profile as many. A reader in Python takes a second for 300 kB.
MAX_BYTES = 64 * 1024
_MAX_DEPTH = 20
# As it is read by everybody; identifiers of CAN are written in hexadecimal.
_WHOLE = re.compile(r"[-+]?[0-9]+|0x[0-9A-Fa-f]+")


class BadYaml(Exception):
    """The text is not what a file of the application may be; the rest of a sentence: "is not valid YAML in line 3"."""


class _PlainLoader(yaml.SafeLoader):
    """Loader that knows no references, which may unfold without end, no second value of a name, and no number that YAML
    takes for another than a person does: 045 is 37 for it, 1:30 is 90, and 1_5 is 15."""

    _depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            raise BadYaml("refers to another part of itself; write the value out")
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise BadYaml("is not valid YAML: too many lists lie within each other")
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            name = key.value if isinstance(key, yaml.ScalarNode) else None
            if name is not None and name in seen:
                raise BadYaml(f"says {name[:40]} twice")
            seen.add(name)
        return super().construct_mapping(node, deep)

    def whole_number(self, node: yaml.ScalarNode) -> int:
        """Of a scalar that YAML takes for one."""
        value: int = self.construct_yaml_int(node)
        text = node.value
        if not _WHOLE.fullmatch(text) or not text.startswith("0x") and int(text) != value:
            raise BadYaml(_ambiguous(node, value))
        return value

    def number(self, node: yaml.ScalarNode) -> float:
        """The same with a decimal point."""
        value: float = self.construct_yaml_float(node)
        if ":" in node.value or "_" in node.value:
            raise BadYaml(_ambiguous(node, value))
        return value


_PlainLoader.add_constructor("tag:yaml.org,2002:int", _PlainLoader.whole_number)
_PlainLoader.add_constructor("tag:yaml.org,2002:float", _PlainLoader.number)


def _ambiguous(node: yaml.ScalarNode, value: float) -> str:
    return (f"says {node.value[:20]} in line {node.start_mark.line + 1}, which YAML takes for {value:.9g}; write the "
            "number that is meant, or the text in quotes")


def load_yaml(path: pathlib.Path) -> Any:
    """Plain values of a file; OSError when it cannot be read, BadYaml when it is not valid."""
    with open(path, "rb") as file:
        content = file.read(MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise BadYaml(f"is larger than {MAX_BYTES // 1024} KiB")
    try:
        return yaml.load(content.decode("utf-8"), _PlainLoader)
    except UnicodeDecodeError:
        raise BadYaml("is not a text file in UTF-8") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" in line {mark.line + 1}" if mark is not None else ""
        raise BadYaml(f"is not valid YAML{where}") from None
    # A date that there is not, a number of thousands of digits, or nesting without end.
    except (ValueError, ArithmeticError, TypeError, AttributeError, LookupError, RecursionError):
        raise BadYaml("is not valid YAML: a value in it cannot be read") from None
