"""Limits files: what they may say, and the sentence for each thing that they may not."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from dataclasses import replace

import pytest

from mtr_operator.domain.errors import InvalidLimits
from mtr_operator.domain.geometry.radials import radials_around
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.verdict.limits_document import MAX_REQUIREMENTS, limits_from
from mtr_operator.domain.verdict.requirement import Requirement
from mtr_operator.domain.verdict.suitability import check_before_start, check_lines
from mtr_operator.storage.given_files import load_limits
from mtr_operator.storage.parameter_file import load_parameters

DOOR = {"name": "door", "what": "unlock", "at_least_m": 1.2, "sides": ["left", "front_left"]}
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
LINES = radials_around(math.radians(45.0))


def refusal(document) -> str:
    """Sentence with which a document is refused."""
    with pytest.raises(InvalidLimits) as caught:
        limits_from(document)
    return str(caught.value)


def refusal_of(**entry) -> str:
    """Sentence about the second entry of a file."""
    return refusal({"limits": [DOOR, {"what": "unlock", "at_least_m": 1.0, **entry}]})


def test_a_whole_file_is_read_and_written_back():
    document = {"further_time_limit_s": 120.0, "limits": [
        DOOR, {"name": "far", "what": "press", "at_least_m": 30.0, "share_percent": 95, "angles_deg": [315.0, 45.0]}]}
    limits = limits_from(document)
    assert limits.to_document() == document
    assert limits_from(limits.to_document()) == limits


def test_what_is_left_out_has_its_default():
    limits = limits_from({"limits": [{"what": "lock", "at_most_m": 3}]})
    assert limits.requirements == (Requirement("limit 1", "lock", None, 3.0),)
    assert limits.further_time_limit_s == 600.0


@pytest.mark.parametrize("document", [None, [], "limits", 3, {}, {"limits": []}, {"limits": {}},
                                      {"limits": [DOOR] * (MAX_REQUIREMENTS + 1)}, {"limits": [DOOR, DOOR]},
                                      {"limits": [DOOR], "further_time_limit_s": -1},
                                      {"limits": [DOOR], "further_time_limit_s": math.nan},
                                      {"limits": [DOOR], "further_time_limit_s": True}, {"limits": [3]}])
def test_a_damaged_file_is_refused_with_one_sentence(document):
    assert refusal(document).endswith(".")


def test_an_unknown_word_is_answered_with_the_likely_one():
    assert refusal({"limit": [DOOR]}) == "'limit' is unknown; did you mean limits?"
    assert refusal_of(at_last_m=3) == "Limit 2: 'at_last_m' is unknown; did you mean at_least_m?"


@pytest.mark.parametrize("entry, piece", [
    ({"at_least_m": None}, "either at_least_m or at_most_m"), ({"at_most_m": 3.0}, "either at_least_m or at_most_m"),
    ({"at_least_m": math.inf}, "distance is inf"), ({"at_least_m": "1,2"}, "distance is '1,2'"),
    ({"at_least_m": True}, "distance is no number"), ({"share_percent": 90}, "one of 5, 50, 95"),
    ({"share_percent": True}, "one of 5, 50, 95"), ({"share_percent": [50]}, "one of 5, 50, 95"),
    ({"sides": "left"}, "list of sides"), ({"sides": []}, "list of sides"), ({"sides": ["port"]}, "'port' is unknown"),
    ({"angles_deg": [1, 2, 3]}, "two angles"), ({"angles_deg": [0, math.nan]}, "angle is nan"),
    ({"angles_deg": [0, 400]}, "more than once"), ({"what": 3}, "what has to be"), ({"what": ""}, "what has to be"),
    ({"name": "two\nlines"}, "name has to be"), ({"name": "x" * 61}, "name has to be")])
def test_a_bad_entry_is_refused_with_its_number(entry, piece):
    sentence = refusal_of(**entry)
    assert sentence.startswith("Limit 2: ")
    assert piece in sentence


def requirement(at_least_m=None, at_most_m=None, **values) -> Requirement:
    """A limit of the distance "press" on all lines."""
    name = f"{at_least_m} {at_most_m} {values}"
    return replace(Requirement(name, "press", at_least_m, at_most_m), **values)


def contradiction(*requirements: Requirement) -> str:
    """Sentence about limits that do not suit the lines, empty when they do."""
    limits = replace(limits_from({"limits": [DOOR]}), requirements=requirements)
    try:
        check_lines(limits, LINES, "radial")
    except InvalidLimits as error:
        return str(error)
    return ""


def test_limits_that_no_car_can_keep_contradict_each_other():
    assert "contradict each other on radial 1" in contradiction(requirement(3.0), requirement(None, 2.0))
    assert "contradict" in contradiction(requirement(None, 2.0), requirement(2.0))
    assert contradiction(requirement(1.0), requirement(None, 2.0)) == ""
    assert contradiction(requirement(3.0), requirement(1.0)) == ""


def test_a_larger_share_works_nearer_and_contradicts_only_that_way():
    sure, half = {"share_percent": 95}, {"share_percent": 50}
    assert "contradict" in contradiction(requirement(3.0, **sure), requirement(None, 2.0, **half))
    assert contradiction(requirement(3.0, **half), requirement(None, 2.0, **sure)) == ""


def test_limits_on_different_lines_or_of_different_distances_do_not_contradict():
    assert contradiction(requirement(3.0, sides=("left",)), requirement(None, 2.0, sides=("right",))) == ""
    assert contradiction(requirement(3.0), requirement(None, 2.0, what="lock")) == ""


def test_a_limit_that_names_no_line_is_refused():
    assert "names no radial" in contradiction(requirement(1.0, angles_deg=(10.0, 20.0)))


@pytest.mark.parametrize("path", sorted((EXAMPLES / "limits").glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_limits_suit_the_shipped_parameters(path):
    scenario = SCENARIOS[path.stem]
    check_before_start(load_limits(path), scenario, load_parameters(EXAMPLES / path.name, scenario.parameters_type))
