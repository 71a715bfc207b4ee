"""Parameter files of the scenarios: YAML, of which JSON is a part."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import TypeVar

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.parameters import ParameterSet

from .plain_yaml import BadYaml, load_yaml

Set = TypeVar("Set", bound=ParameterSet)


def load_parameters(path: pathlib.Path, parameters_type: type[Set]) -> Set:
    """Parameters in a file; InvalidParameter says what is wrong with the file or a parameter."""
    try:
        document = load_yaml(path)
    except OSError as error:
        raise InvalidParameter(f"The parameter file {path} cannot be read: {error.strerror or error}.") from None
    except BadYaml as error:
        raise InvalidParameter(f"The parameter file {path} {error}.") from None
    try:
        if document is None:
            document = {}
        if not isinstance(document, dict):
            raise InvalidParameter("It has to consist of lines of the form 'parameter: value'.")
        return parameters_type.from_mapping(document)
    except InvalidParameter as error:
        raise InvalidParameter(f"Parameter file {path}: {error}") from None
