"""The checkout is a set of catkin packages wherever it lies: built from its top, or cloned into a workspace's src."""
# SPDX-License-Identifier: Apache-2.0
import os
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
