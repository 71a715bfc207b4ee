"""The checkout is a set of catkin packages wherever it lies: built from its top, or cloned into a workspace's src."""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import shutil
import subprocess

import pytest
from project import TOP, package_folders, package_name, tracked


def test_no_two_packages_have_one_name():
    names = [package_name(folder) for folder in package_folders()]
    assert len(names) == len(set(names)) > 10


def test_no_file_is_a_link():
    # A linked folder is found twice by catkin, once under each name.
    assert [path for path in tracked() if path.is_symlink()] == []


@pytest.mark.parametrize("built", [False, True], ids=["fresh", "built"])
def test_a_clone_in_any_workspace_lists_each_package_once(tmp_path, built):
    clone = tmp_path / "src" / "robot"
    for path in tracked("*package.xml"):
        target = clone / path.relative_to(TOP)
        target.parent.mkdir(parents=True)
        shutil.copy(path, target)
    if built:
        copy_what_a_build_leaves(clone)
    environment = dict(os.environ, PATH="/usr/bin:/bin")
    subprocess.run(["catkin", "init"], cwd=tmp_path, env=environment, check=True, capture_output=True)
    done = subprocess.run(["catkin", "list", "--unformatted"], cwd=tmp_path, env=environment, text=True,
                          capture_output=True, check=False)
    listed = done.stdout.split()
    assert done.returncode == 0, done.stderr
    assert sorted(listed) == sorted(package_name(folder) for folder in package_folders())


def copy_what_a_build_leaves(clone):
    """The markers that setup/build.sh makes, and in each marked folder a package that must not be found."""
    script = (TOP / "setup" / "build.sh").read_text(encoding="utf-8")
    marked = ["out", "catkin_ws/build", "catkin_ws/devel", "catkin_ws/logs"]
    command = next(line for line in script.splitlines() if line.startswith("touch ") and "CATKIN_IGNORE" in line)
    for name in marked:
        (clone / name / "copy").mkdir(parents=True)
        shutil.copy(TOP / "proto" / "package.xml", clone / name / "copy")
    subprocess.run(["bash", "-c", command], cwd=clone, check=True)


# Headers of mtr_core and of messages are made while the workspace is built; what compiles against them has to wait.
COMPILED = re.compile(r"add_(?:library|executable)\((\S+)")
WAITS = re.compile(r"add_dependencies\((\S+)\s+\$\{catkin_EXPORTED_TARGETS\}\)")
LINKED = re.compile(r"target_link_libraries\((\S+)((?:\s+[^\s)]+)+)\)")


@pytest.mark.parametrize("folder", package_folders(), ids=package_name)
def test_in_one_common_build_nothing_is_compiled_before_its_headers_are_made(folder):
    text = (folder / "CMakeLists.txt").read_text(encoding="utf-8")
    waiting = set(WAITS.findall(text))
    # A target waits for those that it is linked with.
    links = {target: set(names.split()) for target, names in LINKED.findall(text)}
    needs = "COMPONENTS" in text
    assert sorted(target for target in COMPILED.findall(text) if needs and target not in waiting
                  and not links.get(target, set()) & waiting) == []


def test_the_headers_that_mtr_core_makes_are_a_target_to_wait_for():
    text = (TOP / "catkin_ws" / "src" / "mtr_core" / "CMakeLists.txt").read_text(encoding="utf-8")
    assert re.search(r"catkin_package\([^)]*EXPORTED_TARGETS \$\{PROJECT_NAME\}_headers\)", text)
