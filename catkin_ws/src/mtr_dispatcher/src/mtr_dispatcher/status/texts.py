"""Truncates texts in a Status, so that no node or stranger can make it too large for the application."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import List

from mtr_core.problems import Problem, messages_of
from mtr_proto import robot_link_pb2 as link

MAX_TEXT = 200
# Longest chain of a problem and its causes; more than three have not occurred.
MAX_CHAIN = 8
MAX_ARGUMENTS = 16
CUT_MARK = "..."


def cut(text: str, limit: int = MAX_TEXT) -> str:
    """Return the text, truncated with a mark if it exceeds the limit."""
    return text if len(text) <= limit else text[:limit - len(CUT_MARK)] + CUT_MARK


def cut_problem(problem: Problem) -> Problem:
    """Return the problem with truncated texts; its causes are unchanged."""
    arguments = tuple((cut(name), cut(value)) for name, value in problem.arguments[:MAX_ARGUMENTS])
    return replace(problem, code=cut(problem.code), text=cut(problem.text), arguments=arguments)


def problem_messages(problem: Problem) -> List[link.Problem]:
    """Return the problem and its causes, outermost first, as messages of a Status."""
    return [message for each in list(problem.chain())[:MAX_CHAIN]
            for message in messages_of(cut_problem(each), link.Problem)[:1]]
