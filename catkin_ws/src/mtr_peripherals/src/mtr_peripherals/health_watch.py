"""Warnings from the firmware's counters for the Operator: one sentence at a time, at a limited rate."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, replace
from typing import Optional

# Shortest time between two sentences; events in between are summed up.
QUIET_S = 10.0
# Good copies of the lift's calibration in an intact memory.
ALL_COPIES = 2
# By FirmwareHealth.last_refusal.
REFUSED_FIELDS = {1: "the lift's height", 2: "the LED pattern", 3: "the press id", 4: "the servos", 5: "the strength",
                  6: "the time to hold", 7: "another press under way", 8: "the calibration", 9: "its age",
                  10: "an emergency stop", 11: "the warning signal"}

# By the bits of FirmwareHealth.reset_cause.
RESET_CAUSES = {1: "its power came back", 2: "reset by its port or button",
                4: "its supply was too low; check the servos' supply", 8: "its program hung"}


@dataclass(frozen=True)
class Health:
    """Counters since the board's reset, its last refusal, and its resets, as in FirmwareHealth."""

    refused_commands: int = 0
    last_refusal: int = 0
    checksum_errors: int = 0
    skipped_frames: int = 0
    calibration_copies: int = ALL_COPIES
    resets: int = 0
    reset_cause: int = 0


class HealthWatch:
    """Compares each report with the last one that was reported to the Operator."""

    def __init__(self) -> None:
        self._known: Optional[Health] = None
        self._spoken_s: Optional[float] = None

    def sentence(self, health: Health, now_s: float) -> str:
        """Return a sentence for the Operator; empty if nothing changed or it is too early."""
        known = self._known or replace(health, calibration_copies=ALL_COPIES)
        if _was_reset(known, health):
            known = Health(calibration_copies=known.calibration_copies, resets=known.resets)
        if health.calibration_copies > known.calibration_copies:
            known = replace(known, calibration_copies=health.calibration_copies)
        self._known = known
        if self._spoken_s is not None and now_s - self._spoken_s < QUIET_S:
            return ""
        parts = (_restarted(known, health), _refused(known, health), _line(known, health), _copies(known, health))
        text = " ".join(part for part in parts if part)
        if text:
            self._known, self._spoken_s = health, now_s
        return text


def _was_reset(known: Health, health: Health) -> bool:
    """Return True if the reset count changed or a counter decreased; the counters then start at 0."""
    return (health.resets != known.resets or health.refused_commands < known.refused_commands
            or health.checksum_errors < known.checksum_errors or health.skipped_frames < known.skipped_frames)


def _restarted(known: Health, health: Health) -> str:
    if health.resets == known.resets:
        return ""
    causes = [cause for bit, cause in RESET_CAUSES.items() if health.reset_cause & bit]
    return f"The peripherals' firmware has started again: {', '.join(causes) or 'the cause is not known'}."


def _refused(known: Health, health: Health) -> str:
    count = health.refused_commands - known.refused_commands
    why = REFUSED_FIELDS.get(health.last_refusal, "an unknown reason")
    return f"The peripherals' firmware has refused {count} order(s), the last one because of {why}." if count else ""


def _line(known: Health, health: Health) -> str:
    wrong, skipped = health.checksum_errors - known.checksum_errors, health.skipped_frames - known.skipped_frames
    if not wrong and not skipped:
        return ""
    return (f"The serial line to the peripherals' firmware is disturbed: {wrong} frame(s) with a wrong checksum, "
            f"{skipped} skipped; check cable and ground.")


def _copies(known: Health, health: Health) -> str:
    if health.calibration_copies >= known.calibration_copies:
        return ""
    if health.calibration_copies:
        return "One of two copies of the lift's calibration is damaged; calibrate the lift soon."
    return "The lift is not calibrated: nominal values are in use, so heights may be wrong; calibrate the lift."
