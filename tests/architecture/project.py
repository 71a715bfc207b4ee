"""What the checks of the architecture look at: the checkout's files, its catkin packages, the imports of a file."""
# SPDX-License-Identifier: Apache-2.0
import ast
import functools
import importlib.util
import pathlib
import subprocess
import sysconfig
from typing import FrozenSet, List
from xml.etree import ElementTree

TOP = pathlib.Path(__file__).resolve().parents[2]
# Parts of the Python that every machine has lie here.
STANDARD_FOLDER = pathlib.Path(sysconfig.get_paths()["stdlib"])


def tracked(*patterns: str) -> List[pathlib.Path]:
    """The checkout's files that match one of git's patterns, all without one.

    New files count as soon as they lie there, unless they are ignored.
    """
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", *patterns]
    listed = subprocess.run(command, cwd=TOP, check=True, text=True, capture_output=True).stdout
    return sorted({TOP / name for name in listed.split("\0") if name and (TOP / name).exists()})


def package_folders() -> List[pathlib.Path]:
    """Folders of the catkin packages."""
    return [path.parent for path in tracked("*/package.xml")]


@functools.lru_cache(maxsize=None)
def package_name(folder: pathlib.Path) -> str:
    """Name of the catkin package in a folder."""
    return ElementTree.parse(folder / "package.xml").findtext("name") or ""


def package_folder(name: str) -> pathlib.Path:
    """Folder of the catkin package of a name.

    Raises:
        StopIteration: there is none.
    """
    return next(folder for folder in package_folders() if package_name(folder) == name)


@functools.lru_cache(maxsize=None)
def imports(path: pathlib.Path) -> FrozenSet[str]:
    """All absolute imports of a Python file: each dotted name and its top-level name."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found.add(node.module)
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return frozenset(found | {name.split(".")[0] for name in found})


# Of Python's own modules, those that only Windows has.
WINDOWS_ONLY = {"msvcrt"}


@functools.lru_cache(maxsize=None)
def is_standard(module: str) -> bool:
    """True for what every Python brings along, and for what lies within another module."""
    if "." in module or module in WINDOWS_ONLY:
        return True
    found = importlib.util.find_spec(module) if module != "__main__" else None
    origin = found.origin if found else None
    return origin in ("built-in", "frozen") or (origin is not None and STANDARD_FOLDER in pathlib.Path(origin).parents)
