"""Moved programs also run by their former names, for one version."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import subprocess

import pytest

TOP = pathlib.Path(__file__).resolve().parents[3]
TEMPLATE = (TOP / "launch" / "moved" / "program.in").read_text(encoding="utf-8")
CMAKE = (TOP / "launch" / "CMakeLists.txt").read_text(encoding="utf-8")
MOVED = [(package, program) for package, programs in re.findall(r"^moved\((\w+) ([\w ]+)\)$", CMAKE, re.MULTILINE)
         for program in programs.split()]


def test_every_program_of_the_former_version_is_there():
    assert sorted(program for _, program in MOVED) == [
        "base_contract", "base_stop", "calibrate", "closed", "graph_watch", "play", "preflight", "record",
        "same_decisions", "standstill"]


@pytest.mark.parametrize("package, program", MOVED)
def test_program_is_in_its_package(package, program):
    path = TOP / "catkin_ws" / "src" / package / "scripts" / program
    assert path.stat().st_mode & 0o111
    assert f"scripts/{program}" in (path.parents[1] / "CMakeLists.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("package, program", MOVED)
@pytest.mark.parametrize("status", [0, 4, 255])
def test_former_name_prints_the_new_one_and_passes_on_arguments_output_and_status(tmp_path, package, program, status):
    stub, rosrun = tmp_path / program, tmp_path / "rosrun"
    stub.write_text(TEMPLATE.replace("@package@", package).replace("@program@", program), encoding="utf-8")
    rosrun.write_text(f'#!/bin/sh\nprintf "<%s>" "$@"\nexit {status}\n', encoding="utf-8")
    for path in (stub, rosrun):
        path.chmod(0o755)
    done = subprocess.run([stub, "--out", "a folder", "", "__name:=x"], check=False, capture_output=True, text=True,
                          env={"PATH": f"{tmp_path}:/usr/bin:/bin"})
    assert (done.stdout, done.returncode) == (f"<{package}><{program}><--out><a folder><><__name:=x>", status)
    assert f"rosrun {package} {program}" in done.stderr and len(done.stderr.splitlines()) == 1
