"""Texts in a Status are cut, so that no sentence of a node or stranger makes it too large for the application."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import List

from mtr_core.problems import Problem, messages_of
from mtr_proto import robot_link_pb2 as link

MAX_TEXT = 200
# A problem and its causes; more than three have not been seen.
MAX_CHAIN = 8
MAX_ARGUMENTS = 16
CUT_MARK = "..."


def cut(text: str, limit: int = MAX_TEXT) -> str:
    """The text, or its beginning with a mark."""
    return text if len(text) <= limit else text[:limit - len(CUT_MARK)] + CUT_MARK


def cut_problem(problem: Problem) -> Problem:
    """The problem with its texts cut; the causes are as they were."""
    arguments = tuple((cut(name), cut(value)) for name, value in problem.arguments[:MAX_ARGUMENTS])
    return replace(problem, code=cut(problem.code), text=cut(problem.text), arguments=arguments)


def problem_messages(problem: Problem) -> List[link.Problem]:
    """The problem and its causes, outermost first, for a Status."""
    return [message for each in list(problem.chain())[:MAX_CHAIN]
            for message in messages_of(cut_problem(each), link.Problem)[:1]]
