"""Parameter files of the scenarios: YAML, of which JSON is a part."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Any, TypeVar

import yaml

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.parameters import ParameterSet

Set = TypeVar("Set", bound=ParameterSet)


class _UniqueKeys(yaml.SafeLoader):
    """Loader that does not let a parameter's second value win silently."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> Any:
        names = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        for name in names:
            if names.count(name) > 1:
                raise InvalidParameter(f"Parameter {name} stands twice in the file.")
        return super().construct_mapping(node, deep)


def load_parameters(path: pathlib.Path, parameters_type: type[Set]) -> Set:
    """Parameters in a file; InvalidParameter says what is wrong with the file or a parameter."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise InvalidParameter(f"The parameter file {path} cannot be read: {error.strerror or error}.") from None
    except UnicodeDecodeError:
        raise InvalidParameter(f"The parameter file {path} is not a text file in UTF-8.") from None
    try:
        document = yaml.load(text, _UniqueKeys)
        if document is None:
            document = {}
        if not isinstance(document, dict):
            raise InvalidParameter("It has to consist of lines of the form 'parameter: value'.")
        return parameters_type.from_mapping(document)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" in line {mark.line + 1}" if mark is not None else ""
        raise InvalidParameter(f"The parameter file {path} is not valid YAML{where}.") from None
    except InvalidParameter as error:
        raise InvalidParameter(f"Parameter file {path}: {error}") from None
