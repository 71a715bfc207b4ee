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


# A code is a promise: it stays when its sentence moves to another package.
PACKAGE_OF = {"bringup": "mtr_graph_watch"}

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
        assert row.package == PACKAGE_OF.get(package, f"mtr_{package}") and what.isidentifier() and what == what.lower()


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


# Fields of messages and of plain data that hold a sentence for the Operator.
SENTENCE_FIELDS = {"message", "reason", "error", "problem", "problems", "stop_reason", "lock_reason", "refusal"}
# What these say is read in a terminal, or by a developer.
NOT_FOR_THE_OPERATOR = {"mtr_benchmarks", "mtr_simulation", "mtr_serial_link", "mtr_description"}
ROBOT_PACKAGES = sorted(path.parent.name for path in PACKAGES.glob("*/package.xml")
                        if path.parent.name not in NOT_FOR_THE_OPERATOR)


def sentences_by_hand(path: pathlib.Path) -> Iterator[str]:
    """Places where a file hands out a sentence that no table knows."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and getattr(node.func, "id", getattr(node.func, "attr", "")) == "Problem":
            yield f"{path.name}:{node.lineno} makes a Problem of its own"
        targets: Dict[str, ast.AST] = {}
        if isinstance(node, ast.Call):
            targets = {keyword.arg or "": keyword.value for keyword in node.keywords}
        elif isinstance(node, ast.Assign):
            targets = {getattr(target, "attr", ""): node.value for target in node.targets}
        for name, value in targets.items():
            texts = [part.value for part in ast.walk(value) if isinstance(part, ast.Constant)]
            if name in SENTENCE_FIELDS and any(isinstance(text, str) and " " in text for text in texts):
                yield f"{path.name}:{node.lineno} sets {name} to a text"


@pytest.mark.parametrize("package", ROBOT_PACKAGES)
def test_no_sentence_for_the_operator_is_made_outside_a_table(package):
    paths = [path for path in modules(package) if package != "mtr_core" or path.name != "problems.py"]
    assert not [place for path in paths for place in sentences_by_hand(path)]
    made = [path.name for path in sources(package)
            if re.search(r"problem_with_text\(|\.(message|reason)\s*=\s*\"", path.read_text(encoding="utf-8"))]
    # Python tests of drive control name the locks that are engaged.
    assert set(made) <= {"python_module.cpp"}


def words_in_calls() -> Iterator[str]:
    """Literals that calls put into placeholders."""
    for package in {row.package for row in ROWS}:
        for call in calls_of(package, {row.name: row for row in ROWS if row.package == package}):
            for keyword in call.keywords:
                choices = [keyword.value.body, keyword.value.orelse] if isinstance(keyword.value, ast.IfExp) else [
                    keyword.value]
                yield from (choice.value for choice in choices
                            if isinstance(choice, ast.Constant) and isinstance(choice.value, str))


def test_words_in_placeholders_have_their_czech():
    assert set(words_in_calls()) <= set(TRANSLATION["words"])


def test_no_czech_word_stands_without_its_english():
    texts = [path.read_text(encoding="utf-8") for package in ROBOT_PACKAGES
             for path in (*modules(package), *sources(package), *(PACKAGES / package).rglob("*.hpp"))]
    assert [word for word in TRANSLATION["words"] if not any(f'"{word}"' in text for text in texts)] == []


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
