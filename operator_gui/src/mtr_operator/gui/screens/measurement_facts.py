"""Progress of a test and state of robot and Car, in words and numbers."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from PyQt5.QtWidgets import QFormLayout, QFrame, QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from mtr_operator.domain.verdict.judgement import TestJudgement
from mtr_operator.report.figures import figures_of
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.readiness import Phase
from mtr_operator.station.view_model import ViewModel

from ..figure_text import figure_text
from ..fitting.prose import Prose
from ..forecast_text import forecast_text
from ..i18n import duration, number
from ..names import domain_word, locks_text, scenario_title
from ..sentences import translated
from ..theme.scale import M, S
from ..theme.state import show_state
from ..verdict_text import verdict_text

_CM_PER_M, _KMH_PER_MPS = 100.0, 3.6
_UNKNOWN = "\N{EN DASH}"
# Values that the robot says with each Status.
_OF_ROBOT = ("locks", "key", "speed", "position")


class MeasurementFacts(QFrame):
    """Attributes: percent, bar, left, action: of the test. values: labels by name of what they show.

    age: how old the robot's values are; hidden while they are of now.
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("card")
        self.title, self.percent, self.count = Prose(), QLabel(), Prose()
        self.left, self.action, self.age = Prose(), Prose(), Prose()
        self.bar = QProgressBar()
        self.bar.setAccessibleName(self.tr("Progress of the test"))
        for label, role in ((self.title, "large"), (self.percent, "title"), (self.count, "soft"), (self.left, "soft"),
                            (self.action, ""), (self.age, "error")):
            label.setProperty("role", role)
        self.values = {name: Prose() for name in ("car", "locks", "key", "speed", "position", "newest", "verdict")}
        names = {"car": self.tr("Car"), "locks": self.tr("Locks"), "key": self.tr("Key height"),
                 "speed": self.tr("Speed"), "position": self.tr("Position"), "newest": self.tr("Last result"),
                 "verdict": self.tr("Verdict so far")}
        self._verdict_heading = QLabel()
        rows = QFormLayout()
        rows.setHorizontalSpacing(M)
        rows.setVerticalSpacing(S)
        for name, label in self.values.items():
            heading = self._verdict_heading if name == "verdict" else QLabel()
            heading.setText(names[name])
            heading.setProperty("role", "soft")
            rows.addRow(heading, label)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(S)
        # In one row: on a small laptop the last result would be below the edge.
        head = QHBoxLayout()
        head.setSpacing(M)
        head.addWidget(self.title, 1)
        head.addWidget(self.percent)
        layout.addLayout(head)
        for widget in (self.bar, self.count, self.left, self.action, self.age):
            layout.addWidget(widget)
        layout.addSpacing(M)
        layout.addLayout(rows)
        layout.addStretch(1)

    def show_model(self, model: ViewModel) -> None:
        """Show the newest."""
        scenario = model.current_test.scenario
        self.title.setText(scenario_title(scenario))
        self.percent.setText(f"{model.percent} %")
        self.bar.setValue(model.percent)
        self.count.setText(self.tr("{done} of {total} lines measured").format(done=model.done, total=model.total))
        self.left.setText(self._left_text(model))
        self.left.setVisible(bool(self.left.text()))
        self.action.setText(self._action_text(model))
        self.values["newest"].setText(newest_text(model))
        self._show_verdict(model.judgement)
        car = model.mapped_car
        self.values["car"].setText(_UNKNOWN if car is None else
                                   f"{number(car.length, 2)} m \N{MULTIPLICATION SIGN} {number(car.width, 2)} m")
        if model.robot is not None:
            self._show_robot(model.robot)
        self._show_age(model)

    def _show_age(self, model: ViewModel) -> None:
        """What the robot said last is grey while nothing comes from it."""
        is_stale = model.is_stale
        self.age.setText(self.tr("The values below are {age} s old.").format(age=f"{model.silent_s:.0f}")
                         if is_stale else "")
        self.age.setVisible(is_stale)
        for name in _OF_ROBOT:
            show_state(self.values[name], "stale", is_stale)

    def _show_verdict(self, judgement: TestJudgement | None) -> None:
        verdict = self.values["verdict"]
        verdict.setText("" if judgement is None else verdict_text(judgement))
        for label in (verdict, self._verdict_heading):
            label.setVisible(judgement is not None)

    def _show_robot(self, robot: RobotSnapshot) -> None:
        status = robot.status
        self.values["locks"].setText(locks_text(robot.lock_state))
        self.values["key"].setText(_measure(status.key_height_m, _CM_PER_M, 0, "cm"))
        self.values["speed"].setText(_measure(abs(status.speed_mps), _KMH_PER_MPS, 1, "km/h"))
        self.values["position"].setText(
            f"\N{PLUS-MINUS SIGN}{_measure(status.position_sigma_m, _CM_PER_M, 1, 'cm')}" if status.pose_valid
            else self.tr("not known"))

    def _left_text(self, model: ViewModel) -> str:
        # Nobody knows it while the robot is silent.
        left_s = None if model.is_stale else model.left_s
        left = "" if left_s is None else self.tr("about {time} left").format(time=duration(left_s))
        forecast = forecast_text(model.forecast) if model.phase is Phase.MEASURING else ""
        return "\n".join(filter(None, (left, forecast)))

    def _action_text(self, model: ViewModel) -> str:
        if model.phase is Phase.STOPPING:
            return self.tr("The robot is being stopped.")
        if model.phase is Phase.PAUSED:
            return self.tr("Paused. The line at hand is measured anew after Resume.")
        if model.is_stale:
            return self.tr("Waits until the robot is heard again.")
        return translated(model.action)


def newest_text(model: ViewModel) -> str:
    """The newest result: place, distances, and what else it tells."""
    if not model.results or model.newest is None:
        return _UNKNOWN
    result = model.newest
    test = model.current_test
    figures = zip(result.distances, figures_of(test.scenario, test.parameters, result))
    distances = [f"{domain_word(distance.word)} {figure_text(figure, distance.uncertainty_m)}"
                 for distance, figure in figures]
    told = (*distances, *map(translated, result.findings))
    text = f"{result.number} ({domain_word(result.place)}): {', '.join(told)}"
    if model.judgement is None or not model.judgement.names(result.number):
        return text
    return f"{text} \N{EN DASH} {domain_word(model.judgement.of_line(result.number).word)}"


def _measure(value: float, per_si: float, digits: int, unit: str) -> str:
    return _UNKNOWN if math.isnan(value) else f"{number(value * per_si, digits)} {unit}"
