"""Runs the tests that need no ROS with whatever Python this is, 3.8 or newer: the robot's pure code, on any machine.

Usage: pip install -r setup/pure-requirements.txt; python setup/pure_tests.py [arguments of pytest]
With setup/focal-requirements.txt instead the versions are those of Ubuntu 20.04, the robot's.
"""
# SPDX-License-Identifier: Apache-2.0
import ast
import functools
import os
import pathlib
import subprocess
import sys
from typing import List, Set

import pytest

TOP = pathlib.Path(__file__).resolve().parent.parent
PACKAGES = sorted(path.parent for where in ("*", "catkin_ws/src/*") for path in TOP.glob(f"{where}/package.xml"))
# Built by catkin, parts of ROS, or of Linux alone: a test that needs one of these is none of these tests.
BUILT = {"evdev", "genmsg", "genpy", "mtr_drive_control_core", "mtr_localization_core", "mtr_msgs", "mtr_proto",
         "rosbag", "rosgraph", "roslaunch", "roslib", "rospkg", "rospy", "rostest", "tf2_ros", "urdf_parser_py",
         "xacro"}
# Their tests compare with the built messages, or start the built nodes.
NEED_THE_WORKSPACE = {"launch", "mtr_benchmarks", "mtr_commissioning", "mtr_description", "mtr_drive_control",
                      "mtr_graph_watch", "mtr_recording", "mtr_simulation"}


def main(arguments: List[str]) -> int:
    """Run pytest on the pure tests; its exit status."""
    tests = map(str, chosen_tests())
    sources = [str(folder / "src") for folder in PACKAGES]
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(sources))
    command = [sys.executable, "-m", "pytest", "-q", "--timeout=60", f"--rootdir={TOP}", *settings_for_old_pytest(),
               *arguments, *tests]
    return subprocess.run(command, cwd=TOP, env=environment, check=False).returncode


def settings_for_old_pytest() -> List[str]:
    """Options with which the pytest of Ubuntu 20.04 and Debian 11 runs the packages' tests; none for that of today."""
    is_old = int(pytest.__version__.split(".")[0]) < 7
    return ["-c", str(TOP / "setup" / "old-pytest.ini")] if is_old else []


def chosen_tests() -> List[pathlib.Path]:
    """Test files that need nothing built."""
    packages = [folder for folder in PACKAGES if folder.name not in NEED_THE_WORKSPACE]
    return [path for folder in packages for path in sorted(folder.glob("tests/unit/test_*.py"))
            if not all_modules_of(path) & BUILT]


def all_modules_of(test: pathlib.Path) -> Set[str]:
    """Top-level names of all modules that a test imports, itself or through the project's own files and its helpers."""
    seen, names = {test}, set()
    waiting = [test]
    while waiting:
        for module in modules_of(waiting.pop()):
            names.add("genpy" if module.split(".")[0].endswith("_msgs") else module.split(".")[0])
            new = {*own_files(module), *test.parent.glob(f"{module.split('.')[0]}.py")} - seen
            seen |= new
            waiting += new
    return names


@functools.lru_cache(maxsize=None)
def own_files(module: str) -> List[pathlib.Path]:
    """The project's files that importing a module of this dotted name runs, and its name within the last of them."""
    parts = module.split(".")
    ends = ["/".join(parts[:length]) for length in range(1, len(parts) + 1)]
    return [path for folder in PACKAGES for end in ends
            for path in (folder / "src" / f"{end}.py", folder / "src" / end / "__init__.py") if path.is_file()]


@functools.lru_cache(maxsize=None)
def modules_of(path: pathlib.Path) -> Set[str]:
    """Dotted names of all modules that a file imports."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {".".join(filter(None, (start_of(node, path), alias.name))) for alias in node.names}
    return found


def start_of(node: ast.ImportFrom, path: pathlib.Path) -> str:
    """What stands before the imported names; a relative import is one of the package in whose src the file lies."""
    if not node.level or "src" not in path.parts:
        return node.module or ""
    inside = path.parts[len(path.parts) - path.parts[::-1].index("src"):-node.level]
    return ".".join([*inside, *filter(None, [node.module])])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
