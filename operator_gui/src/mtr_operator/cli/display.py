"""Progress of a test on stderr: a bar on a terminal, plain lines elsewhere."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from typing import TextIO

import tqdm

from mtr_operator.domain.actions.observer import RunObserver
from mtr_operator.domain.eventlog.robot_events import is_alike
from mtr_operator.domain.results.document import shown_text
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.robot_status import Mode, RobotStatus
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.report.table import line_text

from .planning import RunForecast

_SEVERITY = {2: " warning", 3: " error"}
_SILENCE_REPEATED_S = 10.0
_BAR = "{n_fmt} of {total_fmt} |{bar:20}| {remaining} left{postfix}"


class Display(RunObserver):
    """Display of finished lines, the current action, and each sentence of the robot once; scenario: None without lines.

    Attributes: forecast: returns the remaining forecast after each line; None: no forecast.
    """

    def __init__(self, scenario: AnyScenario | None, stream: TextIO | None = None,
                 parameters: ScenarioParameters | None = None):
        self._scenario = scenario
        self._parameters = parameters
        self._stream = stream or sys.stderr
        self._bar: tqdm.tqdm | None = None
        self._logged: set[int] = set()
        self._notified: dict[str, str] = {}
        self._silence_shown_s = 0.0
        self._robot_session_id = 0
        self.forecast: RunForecast | None = None

    def close(self) -> None:
        """End the bar; safe to call twice."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def on_plan(self, done: int, total: int) -> None:
        self.say(f"{total - done} of {total} lines to measure")
        if self.forecast is not None:
            self.forecast.on_plan(done)
        if self._scenario is not None and self._stream.isatty():
            self._bar = tqdm.tqdm(total=total, initial=done, unit=self._scenario.line_word, file=self._stream,
                                  dynamic_ncols=True, bar_format=_BAR)

    def on_action(self, text: str) -> None:
        if self._bar is not None:
            self._bar.set_postfix_str(text)
        else:
            self.say(text)

    def on_result(self, result: LineResult, done: int, total: int) -> None:
        if self._scenario is not None:
            self.say(f"[{done}/{total}] {line_text(self._scenario, result, self._parameters)}")
        expected = "" if self.forecast is None else self.forecast.after_line(done)
        if expected:
            self.say(expected)
        if self._bar is not None:
            self._bar.update(done - self._bar.n)

    def on_status(self, status: RobotStatus) -> None:
        if self.forecast is not None:
            self.forecast.on_status(status)
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id = status.robot_session_id
            self._logged.clear()
        self._silence_shown_s = 0.0
        for message in status.log:
            if message.id not in self._logged:
                self._logged.add(message.id)
                self._print_notice(message.severity, message.text)
        # During its start the robot lacks several things; remaining faults are shown later, or are in the last error.
        if status.mode is not Mode.STARTING:
            self._notify(status)

    def on_link_silent(self, silent_s: float) -> None:
        if not self._silence_shown_s or silent_s - self._silence_shown_s >= _SILENCE_REPEATED_S:
            self._silence_shown_s = silent_s
            self.say(f"no answer from the robot for {silent_s:.0f} s, still trying")

    def say(self, text: str) -> None:
        """Show one or several lines, with the control characters of received texts replaced."""
        text = "\n".join(map(shown_text, text.split("\n")))
        if self._bar is not None:
            self._bar.write(text, file=self._stream)
        else:
            print(text, file=self._stream, flush=True)

    def _notify(self, status: RobotStatus) -> None:
        current = {notification.code: notification for notification in status.notifications}
        for code, notification in current.items():
            said = self._notified.get(code)
            if said is None or not is_alike(said, notification.text):
                self._print_notice(notification.severity, notification.text)
        self._notified = {code: notification.text for code, notification in current.items()}

    def _print_notice(self, severity: int, text: str) -> None:
        self.say(f"robot{_SEVERITY.get(severity, '')}: {' '.join(text.split())}")
