"""Every sentence of the robot has a code, and every code its Czech: the packages' tables against their calls and the
window's translation."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
from string import Formatter
from typing import Dict, Iterator, List, NamedTuple

import pytest
import yaml

TOP = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = TOP / "catkin_ws" / "src"
CZECH = TOP / "operator_gui/src/mtr_operator/gui/translations/robot_cs.yaml"


class Row(NamedTuple):
    """One sentence of a table."""

    package: str
    name: str
    code: str
    template: str


def python_rows() -> Iterator[Row]:
    """Assignments NAME = Sentence(code, template) of each module `problems` but that which defines Sentence."""
    for path in sorted(PACKAGES.glob("*/src/*/problems.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            value = node.value if isinstance(node, ast.Assign) else None
            if isinstance(value, ast.Call) and getattr(value.func, "id", "") == "Sentence":
                code, template = (ast.literal_eval(argument) for argument in value.args)
                yield Row(path.parent.name, node.targets[0].id, code, template)


# constexpr Sentence kName{"code", "text" "more text"};
CPP_ROW = re.compile(r'Sentence (k\w+)\{\s*"([^"]+)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)\}')
CPP_CALL = re.compile(r"problems::(k\w+)\((\{\{.*?\}\})?\)", re.DOTALL)


def cpp_rows() -> Iterator[Row]:
    """Constants of each header `problems.hpp`."""
    for path in sorted(PACKAGES.glob("*/**/problems.hpp")):
        for name, code, literals in CPP_ROW.findall(path.read_text(encoding="utf-8")):
            yield Row(path.relative_to(PACKAGES).parts[0], name, code, ast.literal_eval(f"({literals})"))


ROWS = [*python_rows(), *cpp_rows()]
TRANSLATION = yaml.safe_load(CZECH.read_text(encoding="utf-8"))


def placeholders(template: str) -> List[str]:
    """Names of the placeholders, sorted."""
    return sorted({name for _, name, _, _ in Formatter().parse(template) if name is not None})


def test_codes_are_unique_and_named_for_their_package():
    codes = [row.code for row in ROWS]
    assert len(codes) > 20 and len(codes) == len(set(codes))
    for row in ROWS:
        package, what = row.code.split(".")
        assert f"mtr_{package}" == row.package and what.isidentifier() and what == what.lower()


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.code)
def test_sentence_has_its_czech_with_the_same_placeholders(row):
    assert placeholders(TRANSLATION["sentences"].get(row.code, "")) == placeholders(row.template)
    assert TRANSLATION["sentences"][row.code] not in ("", row.template)


def test_no_czech_stands_without_a_sentence():
    assert set(TRANSLATION["sentences"]) == {row.code for row in ROWS}


def modules(package: str) -> Iterator[pathlib.Path]:
    """Python files of a package, its table excluded."""
    yield from (path for path in sorted((PACKAGES / package / "src" / package).rglob("*.py"))
                if path.name != "problems.py")


def calls_of(package: str, rows: Dict[str, Row]) -> Iterator[ast.Call]:
    """Calls problems.NAME(...) in the package."""
    for path in modules(package):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in rows \
                    and getattr(node.func.value, "id", "") == "problems":
                yield node


@pytest.mark.parametrize("package", sorted({row.package for row in ROWS}))
def test_calls_give_each_placeholder_its_value(package):
    rows = {row.name: row for row in ROWS if row.package == package}
    for call in calls_of(package, rows):
        given, wanted = {keyword.arg for keyword in call.keywords}, set(placeholders(rows[call.func.attr].template))
        # Values that come in a dictionary are left to the unit tests.
        assert not call.args and (given - {None} <= wanted if None in given else given == wanted), ast.dump(call)


def sources(package: str) -> Iterator[pathlib.Path]:
    """C++ sources of a package."""
    yield from sorted((PACKAGES / package / "src").rglob("*.cpp"))


@pytest.mark.parametrize("package", sorted({row.package for row in ROWS}))
def test_calls_in_cpp_give_each_placeholder_its_value(package):
    rows = {row.name: row for row in ROWS if row.package == package}
    for path in sources(package):
        for name, arguments in CPP_CALL.findall(path.read_text(encoding="utf-8")):
            given = sorted(re.findall(r'\{"(\w+)",', arguments))
            assert given == placeholders(rows[name].template), f"{path.name}: {name}"


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.code)
def test_sentence_is_used(row):
    is_used = re.compile(rf"problems(\.|::){row.name}\b")
    assert any(is_used.search(path.read_text(encoding="utf-8"))
               for path in (*modules(row.package), *sources(row.package)))
