"""What the last preflight found, for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from mtr_proto import robot_link_pb2 as link

from ..preflight_report import PreflightReport
from .texts import cut

# Once a second: nobody waits for it, and it is as large as all the rest together.
PREFLIGHT_EVERY = 10
# Its sentences hold value, limit and what to do, and end with the last.
MAX_SENTENCE = 300


def add_preflight(message: link.PreflightReport, report: Optional[PreflightReport]) -> None:
    """Write it; an empty message says that none was made."""
    message.SetInParent()
    if report is None:
        return
    message.made_s, message.checks, message.bad = report.made_s, report.checks, report.bad
    if report.motion_made_s is not None:
        message.motion_made_s = report.motion_made_s
    for item in report.items:
        level = link.SEVERITY_ERROR if item.is_bad else link.SEVERITY_INFO
        message.items.add(name=cut(item.name), level=level, sentence=cut(item.sentence, MAX_SENTENCE))
