"""Readiness and its reasons in words: what is the matter, and what to do about it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.station.readiness import Cause, Readiness, ReadinessWord, Reason

from ..i18n import translate
from ..sentences import translated


def word_text(word: ReadinessWord) -> str:
    """The status word."""
    return {
        ReadinessWord.READY: translate("Status", "Ready"),
        ReadinessWord.WARNINGS: translate("Status", "Ready with warnings"),
        ReadinessWord.NOT_READY: translate("Status", "Not ready"),
        ReadinessWord.MEASURING: translate("Status", "Measuring"),
        ReadinessWord.PAUSED: translate("Status", "Paused"),
        ReadinessWord.LOST: translate("Status", "Communication lost"),
        ReadinessWord.DRIVING: translate("Status", "Driving"),
        ReadinessWord.MAPPING: translate("Status", "Mapping"),
        ReadinessWord.CHECKING: translate("Status", "Checking"),
        ReadinessWord.BLOCKED: translate("Status", "Blocked"),
    }[word]


def reason_text(reason: Reason) -> str:
    """What is the matter."""
    detail = translated(reason.detail)
    return {
        Cause.ROBOT_SILENT: translate("Status", "The robot has not answered for {detail} s."),
        Cause.ROBOT_STARTING: translate("Status", "The robot is still starting."),
        Cause.ROBOT_FAULT: detail or translate("Status", "The robot reports a fault."),
        Cause.OTHER_OPERATOR: translate("Status", "Another application controls the robot."),
        Cause.NOTIFICATION: detail,
        Cause.BATTERY_EMPTY: translate("Status", "The robot's battery is nearly empty: {detail} %."),
        Cause.BATTERY_LOW: translate("Status", "The robot's battery is low: {detail} %."),
        Cause.BATTERY_UNKNOWN: translate("Status", "The robot does not report its charge."),
        Cause.NO_CAN: translate("Status", "No CAN adapter is chosen."),
        Cause.CAN_PROBLEM: detail,
        Cause.LOCKS_UNKNOWN: translate("Status", "The Car does not say whether it is locked."),
        Cause.HELD: detail or translate("Status", "The robot stands until you have it go on."),
        Cause.WAY_BLOCKED: detail or translate("Status", "Something blocks the robot's way."),
        Cause.PREFLIGHT_BAD: translate("Status", "The robot's preflight found: {detail}"),
        Cause.PREFLIGHT_MISSING: detail, Cause.CAR_ACTIVE: detail,
        Cause.POSITION_LOST: detail or translate("Status", "The robot does not know its position."),
    }[reason.cause].replace("{detail}", detail)


def blocked_text(readiness: Readiness) -> str:
    """What blocks the robot, in a sentence; empty when nothing does."""
    if readiness.word is not ReadinessWord.BLOCKED:
        return ""
    return f"{word_text(readiness.word)}: {reason_text(readiness.reasons[0])}"


def advice_text(reason: Reason) -> str:
    """What to do about what the checklist does not name; empty for the others, whose advice check_texts has."""
    return {
        Cause.HELD: translate("Status", "Look at the cause; then have the robot go on."),
        Cause.WAY_BLOCKED: translate("Status", "Clear its way; it goes on by itself, or stands until you have it go "
                                               "on."),
    }.get(reason.cause, "")
