"""Verdicts on the test and its lines as text, with reasons."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.verdict.judgement import TestJudgement
from mtr_operator.domain.verdict.verdict import Verdict

from .table import line_name


def verdict_counts(judgement: TestJudgement) -> str:
    """Return a text such as "3 pass, 1 fail": the number of lines with a limit for each verdict."""
    return ", ".join(f"{count} {verdict.word}" for verdict, count in judgement.counts().items())


def verdict_lines(scenario: AnyScenario, results: Sequence[LineResult],
                  judgement: TestJudgement | None) -> Iterator[str]:
    """Yield the lines that did not pass with the reason, then the verdict on the test; nothing without limits."""
    if judgement is None:
        return
    names = {result.number: line_name(scenario, result) for result in results}
    for each in judgement.judgements:
        if each.verdict is not Verdict.PASS:
            name = names.get(each.line, f"{scenario.line_word} {each.line}")
            yield f"{each.verdict.word.upper()}: {name}, {each.requirement.name}: {each.reason}"
    yield f"Verdict: {judgement.verdict.word.upper()} ({verdict_counts(judgement)})"
