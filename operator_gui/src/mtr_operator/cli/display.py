"""Progress of a test on stderr: a bar on a terminal, plain lines elsewhere."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from typing import Any, Mapping, TextIO

import tqdm

from mtr_operator.domain.observer import RunObserver
from mtr_operator.domain.ports import RobotStatus
from mtr_operator.domain.scenario import REASON, Scenario

_SEVERITY = {1: "info", 2: "warning", 3: "error"}
_SILENCE_REPEATED_S = 10.0


class Display(RunObserver):
    """Shows lines done, the present action, and each sentence of the robot once."""

    def __init__(self, scenario: Scenario, stream: TextIO | None = None):
        self._scenario = scenario
        self._stream = stream or sys.stderr
        self._bar: tqdm.tqdm | None = None
        self._logged: set[int] = set()
        self._notified: dict[str, str] = {}
        self._silence_shown_s = 0.0
        self._robot_session_id = 0

    def close(self) -> None:
        """End the bar; safe to call twice."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def on_plan(self, done: int, total: int) -> None:
        """See RunObserver."""
        self._say(f"{total - done} of {total} lines to measure")
        if self._stream.isatty():
            self._bar = tqdm.tqdm(total=total, initial=done, unit=self._scenario.line_word, file=self._stream,
                                  dynamic_ncols=True)

    def on_action(self, text: str) -> None:
        """See RunObserver."""
        if self._bar is not None:
            self._bar.set_postfix_str(text)
        else:
            self._say(text)

    def on_result(self, result: Mapping[str, Any], done: int, total: int) -> None:
        """See RunObserver."""
        scenario = self._scenario
        states = ", ".join(result[column] for column in scenario.status_columns)
        reason = f": {result[REASON]}" if result[REASON] else ""
        self._say(f"[{done}/{total}] {scenario.line_word} {result[scenario.line_word]}: {states}{reason}")
        if self._bar is not None:
            self._bar.update(done - self._bar.n)

    def on_status(self, status: RobotStatus) -> None:
        """See RunObserver."""
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id = status.robot_session_id
            self._logged.clear()
        self._silence_shown_s = 0.0
        for message in status.log:
            if message.id not in self._logged:
                self._logged.add(message.id)
                self._say(f"robot {_SEVERITY.get(message.severity, '')} ({message.source}): {message.text}")
        current = {notification.code: notification for notification in status.notifications}
        for code, notification in current.items():
            if self._notified.get(code) != notification.text:
                self._say(f"robot {_SEVERITY.get(notification.severity, '')}: {notification.text}")
        self._notified = {code: notification.text for code, notification in current.items()}

    def on_link_silent(self, silent_s: float) -> None:
        """See RunObserver."""
        if not self._silence_shown_s or silent_s - self._silence_shown_s >= _SILENCE_REPEATED_S:
            self._silence_shown_s = silent_s
            self._say(f"no answer from the robot for {silent_s:.0f} s, still trying")

    def _say(self, text: str) -> None:
        if self._bar is not None:
            self._bar.write(text, file=self._stream)
        else:
            print(text, file=self._stream, flush=True)
