"""Key press by search: what is tried on a radial, and what is recorded of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ...actions.line_watch import LineWatch
from ...actions.robot import Robot
from ...estimation.press.radial_search import PRESSES_IN_DOUBT
from ...geometry.radials import Radial
from ...results.document import Texts
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import PRESS, KeyPressResult
from ..line_search.attempt import AttemptMade, AttemptsMade
from ..line_search.forecast import SearchLimits, UsualWidths
from ..line_search.silence import MAX_SILENT_LINES
from ..line_search.trial import Trial
from .button import press_once
from .record import invalid_result, joined, result_of

# Noise of 1 dB in time alone at 8 m, and 5 dB of fading beside it (facts of the range benchmark); between them the one
# for which the interval has to be in reach.
WIDTHS = UsualWidths(0.4, 1.0, 2.2)
_DECLARED = KeyPressParameters.declarations()
LASTING_SILENCE = (
    f"The key has answered nowhere on {MAX_SILENT_LINES} radials one after the other; see whether it sleeps, whether "
    "its battery is empty and whether it is the Car's key, then continue the test, or begin one with a smaller "
    "minimum_distance_m.")
LIMITS = SearchLimits("presses on each radial", int(_DECLARED["attempts_limit"].high), _DECLARED["interval_m"].high)


class RadialTrial(Trial[KeyPressResult]):
    """A radial on which a button is pressed."""

    word = PRESS

    def __init__(self, line: Radial, parameters: KeyPressParameters):
        self.number, self.ray = line.number, line.ray
        self.start = f"radial {line.number} ({line.clockwise_deg:g}\N{DEGREE SIGN}): go to the start"
        self.tolerances = self.parameters = parameters
        self._line = line
        self._key_press = parameters

    def action_at(self, distance_m: float) -> str:
        """See Trial."""
        return f"press at {distance_m:.2f} m"

    def attempt(self, watch: LineWatch, robot: Robot, word: str) -> AttemptMade:
        """See Trial."""
        return press_once(self.ray, watch, self._key_press, robot, word)

    def invalid(self, made: AttemptsMade, reason: str, evidence: Texts = ()) -> KeyPressResult:
        """See Trial."""
        return invalid_result(self._line, made, reason, evidence)

    def result(self, made: AttemptsMade) -> KeyPressResult:
        """See Trial."""
        return result_of(self._line, made)

    def joined(self, before: KeyPressResult, after: KeyPressResult) -> KeyPressResult:
        """See Trial."""
        return joined(before, after)

    @property
    def silence(self) -> str:
        """See Trial."""
        return (f"No press worked, and none of {PRESSES_IN_DOUBT} at {self._key_press.minimum_distance_m:.2f} m "
                "either: the key sleeps, its battery is empty, or the Car's range ends nearer; then decrease "
                "minimum_distance_m.")

    @property
    def lasting_silence(self) -> str:
        """See Trial."""
        return LASTING_SILENCE
