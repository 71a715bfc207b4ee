"""The shape of the house: rooms of at most 16 modules, no circles, C++ cores without ROS, every test in a suite."""
# SPDX-License-Identifier: Apache-2.0
import ast
import collections
import pathlib
import re
from typing import Dict, Iterator, List, Set

import pytest
from project import TOP, package_folders, package_name, tracked

MAX_MODULES = 16

# A library of C++ decides; nodes around it know ROS, and so do libraries with these ends.
LIBRARY = re.compile(r"add_library\((\S+) ([^)]*)\)")
WITH_ROS = ("_replay", "_ros")
# Headers of ROS, of its messages and of this project's part that is made of ROS.
ROS_HEADER = re.compile(r"(ros|rosbag|tf2|tf2_ros|urdf|\w+_msgs)/")
# Folders of tests that setup/run_tests.py runs.
SUITES = ("tests/unit/", "tests/gui/", "tests/end_to_end/", "tests/architecture/", "tests/contract/", "tests/rostest/",
          "tests/system/", "tests/security/", "tests/fuzz/", "tests/host/", "tests/emulated/")


def is_test(path: pathlib.Path) -> bool:
    """In a folder of tests."""
    return "tests" in path.relative_to(TOP).parts


def test_no_folder_has_more_than_16_modules_or_headers():
    count = collections.Counter()
    for path in tracked("*.py", "*.hpp"):
        if not is_test(path) and path.name not in ("__init__.py", "__main__.py", "setup.py"):
            count[(str(path.parent.relative_to(TOP)), path.suffix)] += 1
    large = {folder: number for (folder, _), number in count.items() if number > MAX_MODULES}
    assert large == {}


def module_files() -> Dict[str, pathlib.Path]:
    """Dotted name -> file, of all packages in a src folder."""
    found = {}
    for path in tracked("*/src/*.py"):
        parts = path.relative_to(TOP).with_suffix("").parts
        inside = parts[len(parts) - parts[::-1].index("src"):]
        found[".".join(inside[:-1] if inside[-1] == "__init__" else inside)] = path
    return found


def python_graph() -> Dict[str, Set[str]]:
    """Module -> modules that it imports; a package's __init__ only counts where it is meant."""
    files = module_files()
    return {name: {target for target in resolved(name, path, files) if target != name} for name, path in files.items()}


def resolved(name: str, path: pathlib.Path, files: Dict[str, pathlib.Path]) -> Iterator[str]:
    """The project's modules that a module imports: at its top level, in functions, and for its types alone."""
    base = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in files)
        elif isinstance(node, ast.ImportFrom):
            whole = [*(base[:len(base) - node.level + 1] if node.level else []), *filter(None, [node.module])]
            for alias in node.names:
                inner = ".".join([*whole, alias.name])
                target = inner if inner in files else ".".join(whole)
                if target in files:
                    yield target


def header_graph() -> Dict[str, Set[str]]:
    """Header -> headers of the project that it includes."""
    headers = tracked("*.hpp")
    by_end = {str(path.relative_to(TOP)): path for path in headers}
    return {name: {end for end in by_end for included in includes(path) if end.endswith("/" + included) and end != name}
            for name, path in by_end.items()}


def includes(path: pathlib.Path) -> List[str]:
    """What a C++ file includes; without the way up where a path is relative to the file."""
    return re.findall(r'^#include [<"](?:\.\./)*([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE)


def circles(graph: Dict[str, Set[str]]) -> List[str]:
    """Nodes that lead to themselves."""
    found = []
    for start in sorted(graph):
        reached, waiting = set(), list(graph[start])
        while waiting:
            node = waiting.pop()
            if node not in reached:
                reached.add(node)
                waiting += graph.get(node, ())
        if start in reached:
            found.append(start)
    return found


def test_no_circle_of_python_imports():
    graph = python_graph()
    assert sum(map(len, graph.values())) > 300
    assert circles(graph) == []


def test_no_circle_of_headers():
    graph = header_graph()
    assert sum(map(len, graph.values())) > 30
    assert circles(graph) == []


def pure_sources() -> Iterator[pathlib.Path]:
    """Sources of the libraries that decide, and every header that they bring in."""
    headers = {path: str(path.relative_to(TOP)) for path in tracked("*.hpp")}
    for cmake in tracked("*CMakeLists.txt"):
        for library, sources in LIBRARY.findall(cmake.read_text(encoding="utf-8")):
            if not library.endswith(WITH_ROS):
                files = [cmake.parent / name for name in sources.split() if name.endswith(".cpp")]
                yield from brought_in(files, headers)


def brought_in(sources: List[pathlib.Path], headers: Dict[pathlib.Path, str]) -> Set[pathlib.Path]:
    """Sources and every header of the project that they include, directly or not."""
    waiting, seen = sources, set()
    while waiting:
        path = waiting.pop()
        if path not in seen:
            seen.add(path)
            waiting += [header for header, end in headers.items() for included in includes(path)
                        if end.endswith("/" + included)]
    return seen


@pytest.mark.parametrize("path", sorted(set(pure_sources())), ids=lambda path: str(path.relative_to(TOP)))
def test_a_core_in_cpp_includes_no_ros(path):
    assert [name for name in includes(path) if ROS_HEADER.match(name)] == []


def test_every_test_lies_where_a_suite_runs_it():
    tests = [path for path in tracked("*test_*.py", "*_test.py", "*.test", "*test_*.cpp")
             if path.name.startswith("test_") or path.stem.endswith("_test") or path.suffix == ".test"]
    assert len(tests) > 150
    assert [path for path in tests if not any(suite in str(path.relative_to(TOP)) for suite in SUITES)] == []


def test_every_package_is_where_a_person_looks_for_it():
    for folder in package_folders():
        name = package_name(folder)
        assert name.startswith("mtr_")
        assert name == folder.name or folder.parent == TOP, f"{name} lies in {folder}"
