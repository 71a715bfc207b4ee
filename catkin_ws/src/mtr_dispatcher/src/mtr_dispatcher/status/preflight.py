"""The report of the last preflight in a Status, for the Operator."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

from mtr_proto import robot_link_pb2 as link

from ..preflight_report import PreflightReport
from .texts import cut

# Once a second, because the report is not urgent and as large as the rest of a Status.
PREFLIGHT_EVERY = 10
# A sentence has a value, a limit, and last what to do.
MAX_SENTENCE = 300


def add_preflight(message: link.PreflightReport, report: Optional[PreflightReport]) -> None:
    """Write the report; an empty message means that no preflight was made."""
    message.SetInParent()
    if report is None:
        return
    message.made_s, message.checks, message.bad = report.made_s, report.checks, report.bad
    if report.motion_made_s is not None:
        message.motion_made_s = report.motion_made_s
    for item in report.items:
        level = link.SEVERITY_ERROR if item.is_bad else link.SEVERITY_INFO
        message.items.add(name=cut(item.name), level=level, sentence=cut(item.sentence, MAX_SENTENCE))
