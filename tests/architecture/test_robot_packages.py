"""A robot gets mtr_bringup and what that needs there, and nothing that only other computers need."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import runpy
import subprocess
from typing import Dict, List, Set

import pytest
from catkin_pkg.package import Package, parse_package
from project import TOP, imports, package_folders

SCRIPT = TOP / "setup" / "install-robot.sh"
ROBOT = {"MTR_ROLE": "robot"}


def folders_of_a_robot() -> List[pathlib.Path]:
    """What the installation links into its workspace and gives to rosdep: its own lines, read by its shell."""
    lines = SCRIPT.read_text(encoding="utf-8").partition("packages=(")[2].partition(")")[0]
    command = ["bash", "-c", "echo " + lines.replace("\n", " ")]
    listed = subprocess.run(command, check=True, text=True, capture_output=True)
    return [TOP / name for name in listed.stdout.split()]


def packages(environment: Dict[str, str]) -> Dict[str, Package]:
    """All packages of the project, with their conditions as the environment decides them."""
    found = {}
    for folder in package_folders():
        package = parse_package(str(folder))
        package.evaluate_conditions(environment)
        found[package.name] = package
    return found


def dependencies(package: Package) -> Set[str]:
    """What a package is built and runs with."""
    kinds = (package.build_depends, package.buildtool_depends, package.build_export_depends, package.exec_depends)
    return {depend.name for kind in kinds for depend in kind if depend.evaluated_condition}


def needed_by(name: str, known: Dict[str, Package]) -> Set[str]:
    """A package with the project's packages that it needs, directly or not."""
    found: Set[str] = set()
    left = {name}
    while left:
        found |= left
        left = {needed for each in left for needed in dependencies(known[each])} & set(known) - found
    return found


def test_a_robot_gets_what_mtr_bringup_needs_there_and_no_other_package():
    installed = {parse_package(str(folder)).name for folder in folders_of_a_robot()}
    assert installed == needed_by("mtr_bringup", packages(ROBOT))


@pytest.mark.parametrize("key", ["python3-mujoco-pip", "python3-cantools-pip", "python3-can", "rviz", "qtbase5-dev",
                                 "gazebo_dev", "mtr_simulation", "mtr_benchmarks"])
def test_a_robot_needs_nothing_of(key):
    known = packages(ROBOT)
    assert [name for name in needed_by("mtr_bringup", known) if key in dependencies(known[name])] == []


def test_no_key_of_a_robot_is_installed_by_pip():
    lines = (TOP / "tests" / "architecture" / "noetic_keys.txt").read_text(encoding="utf-8").splitlines()
    by_pip = {line.split()[0] for line in lines if " pip:" in line}
    known = packages(ROBOT)
    needed = {key for name in needed_by("mtr_bringup", known) for key in dependencies(known[name])}
    assert by_pip and not by_pip & needed


def test_other_computers_get_the_simulated_world_and_rviz():
    assert {"mtr_simulation", "rviz"} <= dependencies(packages({})["mtr_bringup"])


def test_commands_of_a_robot_import_nothing_that_it_lacks():
    installed = needed_by("mtr_bringup", packages(ROBOT))
    folders = [folder for folder in folders_of_a_robot() if parse_package(str(folder)).name in installed]
    modules = {path.relative_to(folder / "src").with_suffix("").as_posix().replace("/", "."): path
               for folder in folders for path in (folder / "src").rglob("*.py")}
    scripts = [path for folder in folders for path in (folder / "scripts").glob("*")
               if path.read_text(encoding="utf-8").partition("\n")[0].endswith("python3")]
    left = {name for script in scripts for name in imports(script)}
    seen: Set[str] = set()
    while left:
        seen |= left
        files = [modules[name] for name in left if name in modules]
        left = {name for path in files for name in imports(path)} - seen
    assert len(scripts) > 10 and len(seen & set(modules)) > 50
    assert {name for name in seen if name.startswith("mtr_") and "." not in name} <= installed


# proto is also a package of pip, which finds its modules itself.
SETUPS = [folder / "setup.py" for folder in package_folders()
          if (folder / "setup.py").exists() and folder.name != "proto"]


@pytest.mark.parametrize("path", SETUPS, ids=lambda path: path.parent.name)
def test_every_python_package_is_installed(path, monkeypatch):
    declared = []
    monkeypatch.setattr("catkin_pkg.python_setup.generate_distutils_setup",
                        lambda **arguments: declared.extend(arguments["packages"]) or {})
    monkeypatch.setattr("distutils.core.setup", lambda **_: None)
    monkeypatch.chdir(path.parent)
    runpy.run_path(str(path))
    source = path.parent / "src"
    assert sorted(declared) == sorted(".".join(each.parent.relative_to(source).parts)
                                      for each in source.rglob("__init__.py"))
