"""Unidiomatic phrases become fewer: each area has a limit, which may only fall."""
# SPDX-License-Identifier: Apache-2.0
import pytest
import wording

# Phrases by which an area may lie below its limit, so that a change need not touch the limits each time.
SLACK, SLACK_SHARE = 10, 0.1


def test_no_area_has_more_unidiomatic_phrases_than_its_limit():
    limits = wording.limits()
    above = {area: f"{count}, limit {limits.get(area, 0)}" for area, count in wording.count_areas().items()
             if count > limits.get(area, 0)}
    assert above == {}, "`python tests/architecture/wording.py --list PATTERN` lists the places"


def test_limits_follow_the_counts_down():
    counts = wording.count_areas()
    loose = {area: limit for area, limit in wording.limits().items()
             if limit - counts.get(area, 0) > SLACK + SLACK_SHARE * limit}
    assert loose == {}, "`python tests/architecture/wording.py --update` lowers the limits"


@pytest.mark.parametrize("name, source", [
    ("speech", "# The robot tells its pose."), ("speech", '"""Heard last."""'), ("speech", 'warn("It says no.")'),
    ("anew", "x = 1  # computed anew"), ("stand", "# The robot stands."), ("beside", "# beside the Car"),
    ("take for", "# It is taken for a wall."), ("is no", "# It is no number."), ("person", "# Nobody asks."),
    ("pronoun", "# longer than that of the base"), ("where", "# empty where there is none"),
    ("verbless", '"""Of the robot."""'), ("verbless", "# What is left."), (wording.NAME, "def told_at(): pass"),
    (wording.NAME, "self.said_s = 1"), (wording.NAME, "def f(gone): pass")])
def test_phrase_is_found_in_python(name, source):
    assert list(wording.find([name], "a.py", source))


@pytest.mark.parametrize("file, source", [
    ("a.cpp", "int a;  // as told"), ("a.hpp", "/** The node says so. */"), ("a.cpp", 'log("it was heard");'),
    ("a.md", "The robot obeys."), ("a.yaml", "a: 1  # as said"), ("a.launch", '<arg name="a" doc="what is told"/>'),
    ("a.proto", "int32 a = 1;  // told")])
def test_phrase_is_found_in_each_kind_of_file(file, source):
    assert list(wording.find(["speech"], file, source))


@pytest.mark.parametrize("file, source", [
    ("a.py", "told = 1"), ("a.py", "x = 'told'"), ("a.md", "`told` is a field."), ("a.md", "```\nit said\n```"),
    ("a.cpp", "int told;"), ("a.yaml", "told: 1"), ("a.py", "# It stands for the mean."),
    ("a.py", "# It is no longer used.")])
def test_code_and_idioms_are_not_counted(file, source):
    assert not list(wording.find(wording.PATTERNS, file, source))


@pytest.mark.parametrize("file, area", [
    ("README.md", "README.md"), ("docs/a.md", "docs"), ("docs/safety/a.md", "docs"),
    ("catkin_ws/src/p/src/a.py", "catkin_ws/src/p"), ("operator_gui/README.md", "operator_gui"),
    ("operator_gui/src/mtr_operator/a.py", "operator_gui/src/mtr_operator")])
def test_area_of_a_file_is_its_package_or_folder(file, area):
    assert wording.area(file) == area
