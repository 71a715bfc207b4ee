"""Sentences with code and arguments, and their round trip through messages."""
# SPDX-License-Identifier: Apache-2.0
import pickle
from types import SimpleNamespace

import pytest

from mtr_core.errors import RobotError
from mtr_core.problems import NO_PROBLEM, Problem, ProblemError, Sentence, messages_of, problem_in, problem_of

TOO_CLOSE = Sentence("planner.too_close", "{left_m:.2f} m are left on the {side}; at least {needed_m} m are needed.")
SILENT = Sentence("planner.silent", "Localization is silent.")
LOST = Sentence("planner.lost", "The position is lost. {cause} Map the Car again.")
TWICE = Sentence("planner.twice", "{count} of {count}.")


def test_sentence_is_formatted_once_and_its_values_are_kept():
    problem = TOO_CLOSE(left_m=0.123, side="left", needed_m=0.3)
    assert problem.text == str(problem) == "0.12 m are left on the left; at least 0.3 m are needed."
    assert problem.code == "planner.too_close"
    assert problem.arguments == (("left_m", "0.12"), ("side", "left"), ("needed_m", "0.3"))


def test_cause_stands_in_the_sentence_and_is_no_argument():
    problem = LOST(cause=SILENT())
    assert problem.text == "The position is lost. Localization is silent. Map the Car again."
    assert problem.arguments == () and [each.code for each in problem.chain()] == ["planner.lost", "planner.silent"]


def test_placeholder_may_stand_twice():
    assert TWICE(count=3) == Problem("planner.twice", "3 of 3.", (("count", "3"),))
    assert TWICE.placeholders == ("count", "count")


def test_no_problem_is_false_and_has_no_messages():
    assert not NO_PROBLEM and not list(NO_PROBLEM.chain()) and not messages_of(NO_PROBLEM, SimpleNamespace)
    assert SILENT()


def test_missing_value_is_an_error():
    with pytest.raises(KeyError):
        TOO_CLOSE(left_m=0.1, side="left")


def test_error_carries_its_problem():
    error = ProblemError(SILENT())
    assert str(error) == "Localization is silent." and error.problem == problem_in(error) == SILENT()
    assert problem_in(RobotError("Something.")) == Problem(text="Something.")


def test_error_comes_from_another_process_with_its_problem():
    error = pickle.loads(pickle.dumps(ProblemError(LOST(cause=SILENT()))))
    assert error.problem == LOST(cause=SILENT()) and str(error) == LOST(cause=SILENT()).text


@pytest.mark.parametrize("problem", [NO_PROBLEM, SILENT(), TOO_CLOSE(left_m=0.1, side="left", needed_m=1.0),
                                     LOST(cause=LOST(cause=SILENT()))])
def test_problem_survives_its_way_through_messages(problem):
    assert problem_of(messages_of(problem, SimpleNamespace), problem.text) == problem


def test_a_problem_is_of_the_same_kind_while_only_its_numbers_change():
    close = {(left_m, side): LOST(cause=TOO_CLOSE(left_m=left_m, side=side, needed_m=1.0)).kind
             for left_m in (0.1, 0.2) for side in ("left", "right")}
    assert close[0.1, "left"] == close[0.2, "left"] != close[0.1, "right"]
    assert LOST(cause=SILENT()).kind not in close.values() and NO_PROBLEM.kind == ()
    assert Problem(text="One.").kind != Problem(text="Two.").kind


def test_text_of_a_sender_without_codes_is_a_problem_without_code():
    assert problem_of([], "Something.") == Problem(text="Something.")
    assert problem_of([], "") == NO_PROBLEM
