"""clang-tidy reports findings in every header of the project, and in no other."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re

import pytest
from project import TOP, tracked

# A header counts when its absolute path has this; the configuration nearest to the header is the one that applies.
FILTER = re.compile(r"^HeaderFilterRegex: '(.+)'$", re.MULTILINE)
FOREIGN = ["catkin_ws/devel/include/mtr_msgs/Problem.h", "catkin_ws/devel/include/mtr_core/names.hpp",
           "catkin_ws/build/mtr_core/mtr_core/names.hpp", "firmware/build/generated/definitions.hpp"]


def is_covered(header: pathlib.Path) -> bool:
    """True when findings in this header are reported."""
    nearest = next(folder for folder in header.parents if (folder / ".clang-tidy").exists())
    found = FILTER.search((nearest / ".clang-tidy").read_text(encoding="utf-8"))
    assert found, nearest
    return re.search(found.group(1), str(header)) is not None


def test_each_header_of_the_project_is_covered():
    headers = tracked("*.hpp", "*.h")
    assert len(headers) > 100
    assert [str(header.relative_to(TOP)) for header in headers if not is_covered(header)] == []


@pytest.mark.parametrize("name", FOREIGN)
def test_generated_headers_are_not_covered(name):
    assert not is_covered(TOP / name)


@pytest.mark.parametrize("path", ["/usr/include/eigen3/Eigen/Core", "/opt/ros/noetic/include/ros/ros.hpp",
                                  "/usr/include/c++/12/bits/stl_vector.h"])
def test_headers_of_the_system_are_not_covered(path):
    pattern = FILTER.search((TOP / ".clang-tidy").read_text(encoding="utf-8"))
    assert pattern and not re.search(pattern.group(1), path)
