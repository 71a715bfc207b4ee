"""Counters of the serial line, and diagnosis of its most relevant problem."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from typing import Dict, Optional

from .frames import FrameCounts
from .parameters import SerialParameters

# Bytes without a frame that indicate a problem: longer than any frame of the protocol in use.
MIN_BYTES_WITHOUT_FRAME = 200
MIN_REVISION_1_SYNCS = 3
# Limits of stored sentences and their lengths, because a disturbed line produces ever new corrupt texts.
MAX_REFUSALS = 20
MAX_REFUSAL_CHARACTERS = 200
OTHER_REFUSALS = "other refusals"
# Duration of the warning after an oversized message or a corrupt description.
REFUSAL_SHOWN_S = 60.0


class LineProblem(enum.Enum):
    """Problem of an open port; the value is its text for a person."""

    NONE = ""
    WAITING = "is open and waits for the board's first message"
    SILENT = "is open but silent; check the board's power, the cable and that the firmware is flashed"
    WRONG_BAUD = "gives bytes but no messages; check the baud rate on both sides, and that nothing else prints there"
    REVISION = "speaks revision 1 of the rosserial protocol, this machine revision 2; flash a newer firmware"
    LOST = "has fallen silent; check the board's power and the cable"


class LineHealth:
    """Counters since the start of the program, and the state of the line since the port was opened.

    Attributes:
        bytes_in, frames: received.
        oversized: messages that exceed the buffer of the device.
        unknown_topics: frames of topics without a description.
        refusals: sentences about rejected items, with their counts.
        counts: of the parser.
    """

    def __init__(self, parameters: SerialParameters):
        self._parameters = parameters
        self._started_s = self._now_s = self._refused_s = -math.inf
        self._frame_s: Optional[float] = None
        self._bytes_at_frame = 0
        self.bytes_in = self.frames = self.oversized = self.unroutable = self.unknown_topics = 0
        self.refusals: Dict[str, int] = {}
        self.counts = FrameCounts()
        self._revision_1_at_start = 0

    def start(self, now_s: float) -> None:
        """Reset the state after the port was opened."""
        self._started_s, self._now_s, self._frame_s = now_s, now_s, None
        self._bytes_at_frame = self.bytes_in
        self._revision_1_at_start = self.counts.revision_1_syncs

    def add_bytes(self, size: int, counts: FrameCounts, now_s: float) -> None:
        """Count received bytes."""
        self.bytes_in += size
        self.counts = counts
        if self._frame_s == now_s:
            self._bytes_at_frame = self.bytes_in

    def add_frame(self, now_s: float) -> None:
        """Count a valid frame."""
        self.frames += 1
        self._frame_s = self._now_s = now_s

    def add_dropped(self, name: str, size: int, limit: Optional[int]) -> None:
        """Count a message for the device that was not sent."""
        if limit is None:
            self.unroutable += 1
            return
        self.oversized += 1
        self.add_refusal(f"A message of {size} bytes for {name} was not sent: the firmware takes at most {limit}.")

    def add_refusal(self, sentence: str) -> bool:
        """Count a sentence about a rejected item; return True for a new, stored one."""
        key = sentence[:MAX_REFUSAL_CHARACTERS]
        if key not in self.refusals and len(self.refusals) >= MAX_REFUSALS:
            key = OTHER_REFUSALS
        self.refusals[key] = self.refusals.get(key, 0) + 1
        self._refused_s = self._now_s
        return key != OTHER_REFUSALS and self.refusals[key] == 1

    def has_refused_lately(self, now_s: float) -> bool:
        """Return True for some time after a refusal."""
        return now_s - self._refused_s <= REFUSAL_SHOWN_S

    def problem(self, now_s: float) -> LineProblem:
        """Return the present problem."""
        if self._frame_s is not None and now_s - self._frame_s <= self._parameters.lost_after_s:
            return LineProblem.NONE
        bytes_since_frame = self.bytes_in - self._bytes_at_frame
        if self.counts.revision_1_syncs - self._revision_1_at_start >= MIN_REVISION_1_SYNCS and self._frame_s is None:
            return LineProblem.REVISION
        if bytes_since_frame >= MIN_BYTES_WITHOUT_FRAME:
            return LineProblem.WRONG_BAUD
        if self._frame_s is not None:
            return LineProblem.LOST
        return LineProblem.SILENT if now_s - self._started_s > self._parameters.lost_after_s else LineProblem.WAITING
