"""Verdicts in words of the Operator."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.verdict.judgement import TestJudgement

from .names import domain_word


def verdict_text(judgement: TestJudgement) -> str:
    """Such as "fail (3 pass, 1 fail)"; of no line it is not set."""
    counts = ", ".join(f"{count} {domain_word(verdict.word)}" for verdict, count in judgement.counts().items())
    verdict = domain_word(judgement.verdict.word.replace("_", " "))
    return f"{verdict} ({counts})" if counts else verdict
