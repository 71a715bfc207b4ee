"""The Car from recorded surfaces: files, command line, and what a wrong file gets."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from locator_surfels import PARAMETERS, box

from mtr_car_locator.fit_command import main
from mtr_car_locator.offline import FilesUnusable, fit_files
from mtr_core.se2 import Pose2

CAR = Pose2(-2.0, 1.0, 0.4)


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
    assert main([str(folder), "--parameter", "expected_length_m=4.4"]) == 0
    assert "length 4.5" in capsys.readouterr().out


@pytest.mark.parametrize("arguments, word", [(["--prior", "30", "0", "0"], "nothing of a Car's size"),
                                             (["--parameter", "nonsense=1"], "nonsense")])
def test_command_says_in_one_sentence_what_is_wrong(folder, capsys, arguments, word):
    assert main([str(folder), *arguments]) == 2
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
