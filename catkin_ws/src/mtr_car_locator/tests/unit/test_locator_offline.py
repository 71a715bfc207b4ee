"""The Car from recorded surfaces: files, command line, and reaction to invalid files."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_simulation import BEAMS, BOX, FIELD_RAD, cast, closed
from locator_surfels import LENGTH_M, PARAMETERS, WIDTH_M, box

from mtr_car_locator.fit_command import main
from mtr_car_locator.offline import FilesUnusable, fit_files
from mtr_car_locator.scan import Scan
from mtr_core.se2 import Pose2

CAR = Pose2(-2.0, 1.0, 0.4)
LIDAR = Pose2(0.12, 0.0, 0.0)
FIRST_S, LOOP_S, BIAS_M = 2.0, 12.0, 0.015


@pytest.fixture
def folder(tmp_path):
    start = CAR @ PARAMETERS.car_from_start @ Pose2(0.2, -0.1, 0.05)
    rows = "\n".join(",".join(map(str, row)) for row in box(CAR))
    (tmp_path / "surfaces.csv").write_text(f"# frame map\nx_m,y_m,normal_rad,length_m,sigma_m,hits\n{rows}\n")
    (tmp_path / "key_frames.csv").write_text(
        f"stamp_s,x_m,y_m,heading_rad\n1.0,{start.x},{start.y},{start.heading}\n2.0,9.0,9.0,0.0\n")
    return tmp_path


@pytest.mark.parametrize("prior", [None, CAR @ Pose2(0.5, 0.3, 0.1)])
def test_car_is_found_in_files_with_and_without_a_prior(folder, prior):
    assert fit_files(folder, prior).rectangle.pose.distance_to(CAR) < 0.005


def test_command_prints_the_car(folder, capsys):
    assert main(no_bag, [str(folder), "--parameter", "expected_length_m=4.4"]) == 0
    assert "length 4.5" in capsys.readouterr().out


def no_bag(path, _):
    raise FilesUnusable(f"There is no {path}.")


@pytest.mark.parametrize("arguments, word", [(["--prior", "30", "0", "0"], "nothing of a Car's size"),
                                             (["--parameter", "nonsense=1"], "nonsense"),
                                             (["--bag", "drive.bag"], "There is no drive.bag"),
                                             (["--bag", "a.bag", "--robot", "no.xacro"], "no.xacro cannot be read")])
def test_command_says_in_one_sentence_what_is_wrong(folder, capsys, arguments, word):
    assert main(no_bag, [str(folder), *arguments]) == 2
    said = capsys.readouterr().err
    assert word in said and said.count("\n") == 1


@pytest.mark.parametrize("name, text", [("surfaces.csv", None), ("surfaces.csv", "x_m,y_m\n1,2\n"),
                                        ("key_frames.csv", "stamp_s,x_m,y_m,heading_rad\n"),
                                        ("surfaces.csv", "x_m,y_m,normal_rad,length_m,sigma_m,hits\n1,2,a,4,5,6\n")])
def test_unusable_file_is_named(folder, name, text):
    (folder / name).unlink()
    if text is not None:
        (folder / name).write_text(text)
    with pytest.raises(FilesUnusable, match=name):
        fit_files(folder)


def pose_at(time_s):
    """Return a pose on an ellipse round the Car, facing it."""
    angle = 2.0 * math.pi * (time_s - FIRST_S) / LOOP_S
    x, y = 4.2 * math.cos(angle), 3.2 * math.sin(angle)
    return CAR @ Pose2(x, y, math.atan2(-y, -x))


def scans_round_the_car():
    """Return sweeps of a robot that stops for each of them, with noise and a range bias."""
    rng = np.random.default_rng(3)
    corners = closed(BOX)
    segments = np.hstack([[CAR.apply(x, y) for x, y in corners[:, columns]] for columns in ((0, 1), (2, 3))])
    for time_s in np.arange(FIRST_S + 0.1, FIRST_S + LOOP_S - 0.1, 0.04):
        lidar = pose_at(time_s) @ LIDAR
        angles = -0.5 * FIELD_RAD + np.arange(BEAMS) * FIELD_RAD / BEAMS
        beams = lidar.heading + angles
        ranges = cast(np.full(BEAMS, lidar.x), np.full(BEAMS, lidar.y), beams, segments)
        yield Scan(time_s, 1e-9, angles[0], FIELD_RAD / BEAMS, 0.1, 30.0,
                   ranges + BIAS_M + rng.normal(0.0, 0.02, BEAMS), LIDAR)


@pytest.fixture
def replayed(folder):
    """Write surfaces that are 15 mm too far inside, and the other files of a replay."""
    rows = "\n".join(",".join(map(str, row)) for row in box(CAR, length=LENGTH_M - 0.03, width=WIDTH_M - 0.03))
    (folder / "surfaces.csv").write_text(f"x_m,y_m,normal_rad,length_m,sigma_m,hits\n{rows}\n")
    for name, step_s, more in (("trajectory.csv", 0.02, "valid,map_revision"), ("key_frames.csv", 0.5, "returns")):
        poses = [(time_s, pose_at(time_s)) for time_s in np.arange(FIRST_S, FIRST_S + LOOP_S, step_s)]
        rows = "\n".join(f"{time_s:.6f},{pose.x},{pose.y},{pose.heading},1,0" for time_s, pose in poses)
        (folder / name).write_text(f"stamp_s,x_m,y_m,heading_rad,{more}\n{rows}\n")
    (folder / "summary.json").write_text(f'{{"range_bias_m": {BIAS_M}, "rear_range_bias_m": 9.0}}')
    return folder


def test_scans_of_the_drive_make_the_size_exact(replayed):
    rough, fine = (fit_files(replayed, CAR @ Pose2(0.2, 0.1, 0.05), scans=scans) for scans in
                   ((), scans_round_the_car()))
    assert rough.in_plane.width == pytest.approx(WIDTH_M - 0.03, abs=0.006)
    assert (fine.in_plane.length, fine.in_plane.width) == pytest.approx((LENGTH_M, WIDTH_M), abs=0.004)
    assert fine.rectangle.pose.distance_to(CAR) < 0.003
    assert fine.in_plane.width_sigma < 0.004 and fine.in_plane.length_sigma < 0.004


@pytest.mark.parametrize("name, text", [("trajectory.csv", None), ("summary.json", None), ("summary.json", "{}"),
                                        ("summary.json", "no json")])
def test_file_that_the_scans_need_is_named(replayed, name, text):
    (replayed / name).unlink()
    if text is not None:
        (replayed / name).write_text(text)
    with pytest.raises(FilesUnusable, match=name):
        fit_files(replayed, CAR, scans=scans_round_the_car())


def test_command_takes_the_scans_of_the_bag(replayed, capsys):
    prior = ["--prior", str(CAR.x), str(CAR.y), str(CAR.heading)]
    assert main(lambda *_: scans_round_the_car(), [str(replayed), "--bag", "drive.bag", *prior]) == 0
    plane = next(line for line in capsys.readouterr().out.splitlines() if "plane" in line)
    length, width = (float(part.split()[1]) for part in plane.split(": ")[1].split(", "))
    assert (length, width) == pytest.approx((LENGTH_M, WIDTH_M), abs=0.004)
