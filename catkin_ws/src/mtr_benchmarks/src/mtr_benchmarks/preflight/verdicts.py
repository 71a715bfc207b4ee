"""Whether the preflight says what is wrong, and nothing else."""
# SPDX-License-Identifier: Apache-2.0
from collections import Counter
from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence, Tuple

from mtr_bringup.preflight.finding import NEEDS_MORE, Finding
from mtr_bringup.preflight.motion.judge import MotionJudge
from mtr_bringup.preflight.motion.recording import Recording
from mtr_description.shipped import shipped_geometry

from .assemblies import Assembly
from .drive import MOTION_S


@dataclass(frozen=True)
class Verdict:
    """Of one drive with one assembly: is it the right one, or one that asks for more and says nothing wrong; what was
    said."""

    is_right: bool
    is_undecided: bool
    said: Tuple[str, ...]


def verdict_on(recording: Recording, assembly: Assembly) -> Verdict:
    """What the preflight says MOTION_S after the robot set off."""
    changed = assembly.change(recording)
    start_s: Optional[float] = recording.motion_start_s()
    findings = MotionJudge(shipped_geometry().lidars()).findings(changed.until((start_s or 0.0) + MOTION_S))
    return Verdict(says(findings, assembly.causes), asks_for_more(findings, assembly.causes),
                   tuple(finding.text for finding in findings if finding.is_bad))


def says(findings: Sequence[Finding], causes: Sequence[str]) -> bool:
    """Each bad finding tells one of the causes, and each cause is told."""
    return untold(findings, causes) == []


def asks_for_more(findings: Sequence[Finding], causes: Sequence[str]) -> bool:
    """One finding asks for more, and each other bad one tells one of the causes: a wrong one is wrong all the same."""
    others = [finding for finding in findings if finding.check != NEEDS_MORE]
    return len(others) < len(findings) and untold(others, causes) is not None


def untold(findings: Sequence[Finding], causes: Sequence[str]) -> Optional[List[str]]:
    """Causes that no bad finding tells; None when one tells something else, or what another one has told."""
    left = list(causes)
    for finding in findings:
        if finding.is_bad:
            cause = next((cause for cause in left if cause in finding.text), None)
            if cause is None:
                return None
            left.remove(cause)
    return left


def counts(verdicts: List[Verdict]) -> Dict[str, int]:
    """How many are right, undecided, wrong."""
    kinds = Counter("right" if each.is_right else "undecided" if each.is_undecided else "wrong" for each in verdicts)
    return {kind: kinds[kind] for kind in ("right", "undecided", "wrong")}
