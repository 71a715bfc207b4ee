"""Learning of a Car's profile for window and command line: an adapter in listen-only mode, and the sequence of
prompts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time
from typing import Callable

from mtr_operator.domain.errors import ConnectionFailed, NothingLearned, OperatorError

from ..can_frame import CanFrame
from .findings import Findings, findings_of
from .listener import Listener
from .session import DEFAULT_PROMPTS, REST_S, LearnSession, Stage

# Factory of the listener; its argument receives each frame.
Listen = Callable[[Callable[[CanFrame], None]], Listener]


class Learning:
    """Owner of the adapter from start() to close(). listen: see Listen. clock: the laptop's, monotonic, in s.

    Attributes: session: current stage and prompt. found: findings, None before look_through() has ended.
    """

    def __init__(self, listen: Listen, prompts: int = DEFAULT_PROMPTS,
                 clock: Callable[[], float] = time.monotonic):
        self.session = LearnSession(prompts)
        self._clock = clock
        self._listener = listen(self.session.recording.frame)
        self._failure: OperatorError | None = None
        self.found: Findings | None = None
        self._opening = threading.Thread(target=self._open, name="learn-open", daemon=True)

    def start(self) -> None:
        """Open the adapter in a thread, because some need a second."""
        self._opening.start()

    def tick(self) -> Stage:
        """Advance the time and return the current stage. ConnectionFailed if the adapter cannot be used or was lost;
        NothingLearned if no frame arrived while the Car was left alone."""
        if self._failure is not None:
            raise self._failure
        if self._listener.problem:
            raise ConnectionFailed(self._listener.problem)
        before, stage = self.session.stage, self.session.tick(self._clock())
        if before is Stage.REST and stage is Stage.ASKED and not self.session.recording.count:
            raise NothingLearned(f"Nothing came over the bus in {REST_S:.0f} s; check bit rate, plug and whether the "
                                 "Car is awake.")
        return stage

    def done(self) -> None:
        """Record that the person has brought the Car to the requested state."""
        self.session.done(self._clock())

    def findings(self) -> Findings:
        """Evaluate a complete recording; lasts up to some seconds after a long one of a full bus."""
        self.found = findings_of(self.session.recording)
        return self.found

    def look_through(self) -> None:
        """Evaluate in a thread; `found` has the result afterwards."""
        threading.Thread(target=self.findings, name="learn-look", daemon=True).start()

    def close(self) -> None:
        """Close the adapter; safe to call twice."""
        if self._opening.is_alive():
            self._opening.join()
        self._listener.stop()

    def _open(self) -> None:
        try:
            self._listener.start()
        except OperatorError as error:
            self._failure = error
            return
        self.session.begin(self._clock())
