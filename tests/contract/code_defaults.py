"""Default values in the code, by name, read from the sources. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import ast
import collections
import pathlib
import re
from typing import Any, Dict, Iterator, Set, Tuple

from hazard_file import TOP

# Packages outside the workspace.
_ROOTS = {"firmware": "firmware", "mtr_bringup": "launch", "mtr_operator": "operator_gui", "setup": "setup"}
_NUMBER = r"(\w+) = (-?[\d.]+|true|false);"
# Members of a struct of parameters stand in headers, named constants in all files.
_MEMBER = re.compile(rf"^ +(?:double|bool|int\w*|uint\w+) {_NUMBER}", re.MULTILINE)
_CONSTANT = re.compile(rf"^(?:inline )?constexpr \w+ {_NUMBER}", re.MULTILINE)


def folder(where: str) -> pathlib.Path:
    """Folder or file of PACKAGE or PACKAGE/PATH; the path begins in the package's Python sources when it has any."""
    package, _, rest = where.partition("/")
    root = TOP / _ROOTS.get(package, f"catkin_ws/src/{package}")
    sources = root / "src" / package
    return (sources if rest and sources.is_dir() else root) / rest


def defaults(where: str) -> Dict[str, Set[Any]]:
    """Values of each name below `where`; a name with more than one is ambiguous."""
    found: Dict[str, Set[Any]] = collections.defaultdict(set)
    start = folder(where)
    paths = [start] if start.is_file() else [*start.rglob("*.py"), *start.rglob("*.hpp"), *start.rglob("*.cpp")]
    for path in paths:
        if "tests" not in path.relative_to(TOP).parts:
            for name, value in _of_python(path) if path.suffix == ".py" else _of_cpp(path):
                found[name].add(value)
    return found


def _of_python(path: pathlib.Path) -> Iterator[Tuple[str, Any]]:
    """Constants of a module, and fields of its parameter sets."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        for each in (node, *(node.body if isinstance(node, ast.ClassDef) else ())):
            if isinstance(each, ast.AnnAssign) and isinstance(each.target, ast.Name) and each.value is not None:
                yield from _value(each.target.id, each.value)
            elif isinstance(each, ast.Assign) and isinstance(each.targets[0], ast.Name):
                yield from _value(each.targets[0].id, each.value)


def _value(name: str, node: ast.expr) -> Iterator[Tuple[str, Any]]:
    """A literal, or the first argument of `number(...)`."""
    is_number = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "number"
    literal = node.args[0] if is_number and isinstance(node, ast.Call) else node
    try:
        value = ast.literal_eval(literal)
    except ValueError:
        return
    if isinstance(value, (bool, int, float, str)):
        yield name, value


def _of_cpp(path: pathlib.Path) -> Iterator[Tuple[str, Any]]:
    """Members of structs and named constants whose value is a literal."""
    text = path.read_text(encoding="utf-8")
    members = _MEMBER.findall(text) if path.suffix == ".hpp" else []
    for name, value in [*members, *_CONSTANT.findall(text)]:
        yield name, ast.literal_eval(value.title() if value in ("true", "false") else value)
