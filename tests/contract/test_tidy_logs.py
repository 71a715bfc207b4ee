"""The logs of an installed robot: old runs go, many runs go, a file that floods is cut; the present run stays."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
import time

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "setup" / "robot" / "tidy_logs"
DAY_S = 24 * 3600.0
MB = 1000 * 1000


def make_run(folder, name, age_days, size=10):
    """A run's folder as roslaunch makes it; a file with a hole takes no room on the disk of the test."""
    run = folder / name
    run.mkdir()
    log = run / "node-1.log"
    log.touch()
    os.truncate(log, size)
    os.utime(log, (time.time() - age_days * DAY_S,) * 2)
    return run


@pytest.fixture
def logs(tmp_path):
    """A folder of logs with a present run, which is older than any bound: it has not written for long."""
    present = make_run(tmp_path, "present", 30)
    (tmp_path / "latest").symlink_to(present)
    return tmp_path


def left(folder):
    """The runs that are left after the script."""
    subprocess.run([sys.executable, SCRIPT, folder], check=True)
    return {path.name for path in folder.iterdir()} - {"latest"}


def test_runs_that_ended_long_ago_are_removed(logs):
    make_run(logs, "old", 15)
    make_run(logs, "young", 13)
    assert left(logs) == {"present", "young"}


def test_the_oldest_runs_are_removed_until_the_rest_is_small_enough(logs):
    for age in (1, 2, 3, 4):
        make_run(logs, f"age {age}", age, 400 * MB)
    assert left(logs) == {"present", "age 1", "age 2"}


def test_a_file_of_the_present_run_that_has_grown_too_large_begins_anew_and_removes_no_run(logs):
    os.truncate(logs / "present" / "node-1.log", 2000 * MB)
    make_run(logs, "young", 1)
    assert left(logs) == {"present", "young"} and (logs / "present" / "node-1.log").stat().st_size == 0


def test_a_node_goes_on_writing_into_a_file_that_was_cut(logs):
    with open(logs / "present" / "node-1.log", "a", encoding="ascii") as log:
        os.truncate(log.name, 200 * MB)
        left(logs)
        log.write("after")
    assert (logs / "present" / "node-1.log").read_text(encoding="ascii") == "after"


def test_what_a_link_names_elsewhere_is_left_alone(logs, tmp_path_factory):
    elsewhere = make_run(tmp_path_factory.mktemp("elsewhere"), "run", 50, 200 * MB)
    (logs / "link").symlink_to(elsewhere)
    left(logs)
    assert (elsewhere / "node-1.log").stat().st_size == 200 * MB


def test_an_empty_folder_is_fine(tmp_path):
    assert left(tmp_path) == set()
