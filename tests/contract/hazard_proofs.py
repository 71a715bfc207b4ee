"""What a proof may name: tests, cells of the fault matrix, rows of benchmarks, read from the sources. No ROS."""
# SPDX-License-Identifier: Apache-2.0
import ast
import functools
import pathlib
import re
from typing import Callable, Dict, FrozenSet, Iterator

from hazard_file import TOP

from mtr_benchmarks.faults.matrix import read_matrix

_GTEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
_SOURCES = ("catkin_ws", "firmware", "launch", "operator_gui", "proto", "tests")
_BUILT = {"build", "devel", "logs", "out"}


def kinds() -> Dict[str, Callable[[], FrozenSet[str]]]:
    """Kind of a proof and the names that there are; `record`, a measurement on a robot, comes with the first one."""
    return {"gtest": gtests, "pytest": pytests, "rostest": rostests, "cell": cells, "row": rows}


def exists(proof: str) -> bool:
    """True when the source has what `KIND:NAME` names."""
    kind, _, name = proof.partition(":")
    return kind in kinds() and name in kinds()[kind]()


@functools.lru_cache(maxsize=None)
def gtests() -> FrozenSet[str]:
    """C++ tests, as SUITE.NAME."""
    return frozenset(f"{suite}.{name}" for path in _files("*.cpp")
                     for suite, name in _GTEST.findall(path.read_text(encoding="utf-8")))


@functools.lru_cache(maxsize=None)
def pytests() -> FrozenSet[str]:
    """Tests that pytest runs, as FILE::NAME without suffix."""
    return frozenset(name for path in _files("test_*.py") if "rostest" not in path.parts for name in _functions(path))


@functools.lru_cache(maxsize=None)
def rostests() -> FrozenSet[str]:
    """Tests with a ROS master, as FILE::NAME without suffix."""
    return frozenset(name for path in _files("*_test.py") if "rostest" in path.parts for name in _functions(path))


@functools.lru_cache(maxsize=None)
def cells() -> FrozenSet[str]:
    """Cells of the fault matrix by name."""
    return frozenset(cell.name for cell in read_matrix().cells)


@functools.lru_cache(maxsize=None)
def rows() -> FrozenSet[str]:
    """Rows of benchmarks with a limit that must be met, as PART: TITLE."""
    folder = TOP / "catkin_ws/src/mtr_benchmarks/src/mtr_benchmarks"
    return frozenset(f"{path.relative_to(folder).parts[0]}: {title}" for path in folder.rglob("*.py")
                     for title in _titles(path))


def _titles(path: pathlib.Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Requirement" and node.args:
            title, has_limit = node.args[0], len(node.args) > 3 or any(each.arg == "must" for each in node.keywords)
            if isinstance(title, ast.Constant) and has_limit:
                yield str(title.value)


def _functions(path: pathlib.Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            yield f"{path.stem}::{node.name}"


def _files(pattern: str) -> Iterator[pathlib.Path]:
    for folder in _SOURCES:
        yield from (path for path in sorted((TOP / folder).rglob(pattern))
                    if not _BUILT & set(path.relative_to(TOP).parts))
