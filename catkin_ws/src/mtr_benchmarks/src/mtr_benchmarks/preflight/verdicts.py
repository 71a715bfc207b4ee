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
    """Of one drive with one assembly: is it the right one, or one that asks for more; what was said."""

    is_right: bool
    is_undecided: bool
    said: Tuple[str, ...]


def verdict_on(recording: Recording, assembly: Assembly) -> Verdict:
    """What the preflight says MOTION_S after the robot set off."""
    changed = assembly.change(recording)
    start_s: Optional[float] = recording.motion_start_s()
    findings = MotionJudge(shipped_geometry().lidars()).findings(changed.until((start_s or 0.0) + MOTION_S))
    return Verdict(says(findings, assembly.causes), any(finding.check == NEEDS_MORE for finding in findings),
                   tuple(finding.text for finding in findings if finding.is_bad))


def says(findings: Sequence[Finding], causes: Sequence[str]) -> bool:
    """Each bad finding tells one of the causes, and each cause is told."""
    left = list(causes)
    for finding in findings:
        if finding.is_bad:
            cause = next((cause for cause in left if cause in finding.text), None)
            if cause is None:
                return False
            left.remove(cause)
    return not left


def counts(verdicts: List[Verdict]) -> Dict[str, int]:
    """How many are right, undecided, wrong."""
    kinds = Counter("right" if each.is_right else "undecided" if each.is_undecided else "wrong" for each in verdicts)
    return {kind: kinds[kind] for kind in ("right", "undecided", "wrong")}
