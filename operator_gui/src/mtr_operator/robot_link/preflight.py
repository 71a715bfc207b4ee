"""Converts the report of a preflight to and from its message."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.robot_status import PreflightItem, PreflightReport
from mtr_proto import robot_link_pb2 as pb

# Largest number of items that a robot sends.
_MAX_ITEMS = 64


def preflight_from(message: pb.PreflightReport) -> PreflightReport:
    """Return the report. An item without a good state counts as bad; a report without a valid time is absent."""
    if not message.HasField("made_s") or not math.isfinite(message.made_s):
        return PreflightReport()
    items = tuple(PreflightItem(item.name, item.level != pb.SEVERITY_INFO, item.sentence)
                  for item in message.items[:_MAX_ITEMS])
    return PreflightReport(message.made_s, items, max(message.checks, len(items)),
                           max(message.bad, sum(item.is_bad for item in items)), _motion_made_s(message))


def _motion_made_s(message: pb.PreflightReport) -> float:
    """Return the time of the motion check; NaN if it is invalid."""
    is_told = message.HasField("motion_made_s") and math.isfinite(message.motion_made_s)
    return float(message.motion_made_s) if is_told else math.nan


def preflight_message(report: PreflightReport) -> pb.PreflightReport:
    """Return the message that a robot sends."""
    if math.isnan(report.made_s):
        return pb.PreflightReport()
    items = [pb.PreflightItem(name=item.name, sentence=item.sentence,
                              level=pb.SEVERITY_ERROR if item.is_bad else pb.SEVERITY_INFO) for item in report.items]
    message = pb.PreflightReport(made_s=report.made_s, items=items, checks=report.checks, bad=report.bad)
    if not math.isnan(report.motion_made_s):
        message.motion_made_s = report.motion_made_s
    return message
