"""A parameter file to begin with: what is proposed, with unit, range and meaning beside each entry."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import pathlib
from typing import Iterator

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.scenario import AnyScenario


def template_text(scenario: AnyScenario) -> str:
    """YAML that load_parameters takes; what has no default stands in it as a comment."""
    return "\n".join([f"# Parameters of the scenario {scenario.name}, as they are proposed.", *_lines(scenario), ""])


def write_template(path: pathlib.Path, scenario: AnyScenario) -> None:
    """A new file; OutputError when it cannot be written, or is there already."""
    try:
        with open(path, "x", encoding="utf-8") as file:
            file.write(template_text(scenario))
    except FileExistsError:
        raise OutputError(f"The file {path} is there already; give another name, or remove it.") from None
    except OSError as error:
        raise OutputError(f"The file {path} cannot be written: {error.strerror or error}.") from None


def _lines(scenario: AnyScenario) -> Iterator[str]:
    kind = scenario.parameters_type
    proposed = kind.proposed()
    for name, chosen in kind.choices().items():
        yield from _entry(name, proposed.get(name, chosen.default), f"{chosen.allowed}. {chosen.doc}")
    for declared in kind.declarations().values():
        only = "" if declared.only is None else f" Only with {declared.only[0]}: {declared.only[1]}."
        yield from _entry(declared.file_key, declared.default, f"{declared.allowed}. {declared.doc}{only}")
    for name, declared_flag in kind.flags().items():
        yield from _entry(name, declared_flag.default, declared_flag.doc)


def _entry(key: str, value: object, doc: str) -> Iterator[str]:
    yield f"# {' '.join(doc.split())}"
    yield f"# {key}:" if value is None else f"{key}: {value if isinstance(value, str) else json.dumps(value)}"
