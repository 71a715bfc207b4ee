"""Compares the preflight's findings with the fault of an assembly."""
# SPDX-License-Identifier: Apache-2.0
from collections import Counter
from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence, Tuple

from mtr_description.shipped import shipped_geometry
from mtr_motion_check.finding import NEEDS_MORE, Finding
from mtr_motion_check.judge import MotionJudge
from mtr_motion_check.recording import Recording

from .assemblies import Assembly
from .drive import MOTION_S


@dataclass(frozen=True)
class Verdict:
    """Verdict on one drive with one assembly.

    Attributes:
        is_right: it reports exactly the fault.
        is_undecided: it requests more motion and reports nothing wrong.
        said: texts of the bad findings.
    """

    is_right: bool
    is_undecided: bool
    said: Tuple[str, ...]


def verdict_on(recording: Recording, assembly: Assembly) -> Verdict:
    """Return the preflight's verdict MOTION_S after the robot has started to move."""
    changed = assembly.change(recording)
    start_s: Optional[float] = recording.motion_start_s()
    findings = MotionJudge(shipped_geometry().lidars()).findings(changed.until((start_s or 0.0) + MOTION_S))
    return Verdict(says(findings, assembly.causes), asks_for_more(findings, assembly.causes),
                   tuple(finding.text for finding in findings if finding.is_bad))


def says(findings: Sequence[Finding], causes: Sequence[str]) -> bool:
    """Return True if each bad finding names one of the causes, and each cause is named."""
    return untold(findings, causes) == []


def asks_for_more(findings: Sequence[Finding], causes: Sequence[str]) -> bool:
    """Return True if one finding requests more motion and every other bad one names a cause; a wrong finding stays
    wrong."""
    others = [finding for finding in findings if finding.check != NEEDS_MORE]
    return len(others) < len(findings) and untold(others, causes) is not None


def untold(findings: Sequence[Finding], causes: Sequence[str]) -> Optional[List[str]]:
    """Return the causes that no bad finding names; None if a finding names something else, or a cause twice."""
    left = list(causes)
    for finding in findings:
        if finding.is_bad:
            cause = next((cause for cause in left if cause in finding.text), None)
            if cause is None:
                return None
            left.remove(cause)
    return left


def counts(verdicts: List[Verdict]) -> Dict[str, int]:
    """Return the numbers of right, undecided and wrong verdicts."""
    kinds = Counter("right" if each.is_right else "undecided" if each.is_undecided else "wrong" for each in verdicts)
    return {kind: kinds[kind] for kind in ("right", "undecided", "wrong")}
