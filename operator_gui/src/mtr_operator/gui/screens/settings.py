"""The settings screen of a scenario: its parameters, and what the robot will do with them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtGui import QHideEvent, QShowEvent
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from mtr_operator.domain.clocks.simulated_time import is_simulated_robot
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.station.checks.checklist import Wanted, hindrances
from mtr_operator.station.checks.finding import Check, Item
from mtr_operator.station.estimate import USUAL_CAR, Plan, plan_of
from mtr_operator.station.readiness import Readiness
from mtr_operator.station.sight.ways import Ways, beside_car, spans, ways_of
from mtr_operator.station.view_model import ViewModel

from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..forecast_text import forecast_text
from ..forms.given_form import GivenForm
from ..forms.hold_button import HoldButton
from ..forms.identity_form import IdentityForm
from ..forms.parameter_form import ParameterForm
from ..header.check_texts import check_text
from ..header.conditions_form import ConditionsForm
from ..i18n import duration, number
from ..names import domain_word, scenario_title
from ..pictures.layers.car_layer import CarLayer
from ..pictures.layers.lines_layer import LinesLayer
from ..pictures.layers.sight_layer import ObstaclesLayer
from ..pictures.layers.surroundings import GridLayer, ScaleLayer
from ..pictures.picture_panel import PicturePanel
from ..sentences import in_window_words, parameter_sentence
from ..theme.appearance import Appearance
from ..theme.scale import L, M, S

# Least of it beside the longest sentences; what has no room scrolls.
_PICTURE_HEIGHT = 240


class SettingsScreen(QWidget):
    """Attributes: form: the parameters. given: files that go with them. identity: car, key and who measures.
    conditions: what is confirmed before a test on a real robot. picture: preview. start: the button.

    notice: sentence on duration and battery. caution: what the parameters cannot give.

    Signals: started(parameters, paths of the files given, what is said of the identity), back.
    """

    started = pyqtSignal(object, object, object)
    back = pyqtSignal()

    def __init__(self, scenario: AnyScenario, model: ViewModel, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        self._scenario = scenario
        self._model = model
        self._plan: Plan | None = None
        self._shown: tuple[object, ...] = ()
        self._judged: tuple[Readiness, tuple[Item, ...]] | None = None
        # Without a valid plan the view stays as it was.
        self._lines = LinesLayer()
        self._obstacles = ObstaclesLayer()
        self._seen_mark = (-1, -1)
        self._ways: Ways | None = None
        self.form = ParameterForm(scenario.parameters_type)
        self.given = GivenForm(scenario)
        self.identity = IdentityForm()
        self.conditions = ConditionsForm(scenario)
        self.picture = PicturePanel(appearance)
        self.picture.setMinimumHeight(_PICTURE_HEIGHT)
        # Where there is less room than it likes it is smaller; nothing scrolls for that.
        self.picture.view.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
        self.notice = Prose()
        self.caution = Prose()
        self.caution.setProperty("role", "error")
        self.start = HoldButton(self.tr("Hold to start"))
        self.start.setProperty("role", "primary")
        self.start.held.connect(self._start)
        self._hindrance = Prose()
        self._hindrance.setProperty("role", "error")
        self._lay_out()
        self.form.changed.connect(self._preview)
        self.given.changed.connect(self._preview)
        self.identity.changed.connect(self._judge)
        self.conditions.changed.connect(self._confirm)
        self._preview()

    def _lay_out(self) -> None:
        title = QLabel(scenario_title(self._scenario))
        title.setProperty("role", "heading")
        given = QVBoxLayout()
        given.setSpacing(M)
        given.addWidget(self.identity)
        given.addWidget(self.form, 1)
        given.addWidget(self.given)
        given.addWidget(self.conditions)
        back = QPushButton(self.tr("Back"))
        back.clicked.connect(self.back)
        buttons = QHBoxLayout()
        buttons.setSpacing(M)
        buttons.addWidget(back)
        buttons.addStretch(1)
        buttons.addWidget(self.start)
        left = QVBoxLayout()
        left.setSpacing(M)
        left.addWidget(title)
        left.addWidget(Scroller(given), 1)
        # Below the fields it would be seen only by who scrolls there.
        left.addWidget(self.form.fault)
        left.addWidget(self._hindrance)
        left.addLayout(buttons)
        right = QVBoxLayout()
        right.setSpacing(S)
        # Above the picture, which on a small screen reaches below the edge: what speaks against the test is seen first.
        right.addWidget(self.caution)
        right.addWidget(self.notice)
        right.addWidget(self.picture, 1)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(L)
        layout.addLayout(left, 11)
        layout.addWidget(Scroller(right), 10)

    def show_model(self) -> None:
        """Something of robot or Car is another one."""
        status = self._model.robot.status if self._model.robot else None
        shown = (self._model.mapped_car, status and status.battery_percent, self._model.facts, self._is_real)
        if shown != self._shown:
            self._shown = shown
            self._preview()
        elif self._model.obstacles.mark != self._seen_mark:
            self._show_obstacles()
            self._tell_wanted()
            self.picture.view.refresh()
        if self._standing() != self._judged:
            self._judge()

    def _preview(self) -> None:
        parameters, mapped = self.form.parameters, self._model.mapped_car
        car = mapped or USUAL_CAR
        self._plan = None
        self._lines.is_visible = False
        if parameters is not None:
            try:
                self._plan = plan_of(self._scenario, parameters, car, mapped is not None, self._model.facts)
                self.form.mark_fields("")
                self.form.show_fault("")
                self._lines.stretches, self._lines.is_visible = self._plan.stretches, True
            except InvalidParameter as error:
                self.form.mark_fields(str(error))
                self.form.show_fault(parameter_sentence(error, self._scenario.parameters_type))
        self._show_obstacles()
        self.picture.view.show_layers([GridLayer(), self._obstacles, self._lines, CarLayer(car, mapped is not None),
                                       ScaleLayer()])
        self._judge()
        if self.isVisible():
            self._tell_wanted()

    def _show_obstacles(self) -> None:
        """What stands around the Car, and what speaks against the parameters."""
        obstacles, parameters, car = self._model.obstacles, self.form.parameters, self._model.mapped_car
        self._seen_mark = obstacles.mark
        self._obstacles.places = obstacles.places if car is None else beside_car(obstacles.places, car)
        self._ways = None if car is None or self._plan is None else ways_of(self._plan.stretches, car, obstacles)
        cautions = [in_window_words(sentence, self._scenario.parameters_type)
                    for sentence in (*(self._plan.cautions if self._plan else ()), *self.given.cautions(parameters))]
        self.caution.setText(" ".join(filter(None, (*cautions, self._hindered()))))
        self.caution.setVisible(bool(self.caution.text()))
        self.notice.setText(" ".join(filter(None, (self._forecast(car is not None), self._unseen()))))

    def _hindered(self) -> str:
        """A sentence on lines that are not free; empty while all are, or the Car is not measured."""
        if self._ways is None or not self._ways.hindered:
            return ""
        return self.tr("Something stands in the way of {lines}: grey squares, the nearest {distance} m from the Car. "
                       "Move it, or measure from nearer.").format(
            lines=self._named(self._ways.hindered), distance=number(self._ways.gap_m, 1))

    def _unseen(self) -> str:
        """A sentence on lines that lead where the robot has not looked; nothing while it sees nothing at all."""
        if self._ways is None or not self._ways.unseen or not self._seen_mark[1]:
            return ""
        return self.tr("Not all seen by the robot yet: {lines}.").format(lines=self._named(self._ways.unseen))

    def _named(self, labels: Sequence[str]) -> str:
        return f"{domain_word(self._scenario.line_word)} {spans(labels)}"

    def showEvent(self, event: QShowEvent) -> None:
        """See QWidget."""
        super().showEvent(event)
        self.conditions.clear()
        self._tell_wanted()

    def hideEvent(self, event: QHideEvent) -> None:
        """See QWidget; nothing is about to begin any more."""
        super().hideEvent(event)
        self._model.wanted = Wanted()

    def _tell_wanted(self) -> None:
        """What is about to begin, for the checklist."""
        self._model.wanted = Wanted(self._plan, self.given.limit_count, self.given.limits_problem, self._ways,
                                    self.conditions.confirmed)

    def _forecast(self, is_mapped: bool) -> str:
        plan = self._plan
        if plan is None:
            return self.tr("No preview of the lines while the parameters are not right.")
        lines = self.tr("{count} lines ({word}), about {time}.").format(
            count=len(plan.stretches), word=domain_word(self._scenario.line_word), time=duration(plan.duration_s))
        lines = " ".join(filter(None, (lines, forecast_text(plan.forecast))))
        if not is_mapped:
            lines += " " + self.tr("The Car is not measured yet; its size is a guess.")
        battery = self._model.robot.status.battery_percent if self._model.robot else None
        if battery is None:
            return lines
        if plan.suffices(battery):
            return lines + " " + self.tr("The battery, at {percent} %, suffices.").format(percent=battery)
        warning = self.tr("The battery, at {percent} %, may not suffice: the test takes about {need} %.")
        return lines + " " + warning.format(percent=battery, need=round(plan.battery_percent))

    def _standing(self) -> tuple[Readiness, tuple[Item, ...]]:
        """Readiness and hindrances now; with the silence of the robot they become others from one call to the next."""
        return self._model.readiness, hindrances(self._model.checklist)

    def _judge(self) -> None:
        self._judged = readiness, bad = self._standing()
        # The fields of the files say themselves what is wrong with them.
        missing = [item for item in bad if item.check is not Check.LIMITS]
        self.conditions.ask(self._is_real)
        told = [*map(check_text, missing), *filter(None, (self._unconfirmed,))]
        self._hindrance.setText(" ".join(told))
        self._hindrance.setVisible(bool(told))
        is_given_well = self.given.judge(None if self._plan is None else self.form.parameters)
        is_well = is_given_well and not self.identity.problem
        self.start.setEnabled(self._plan is not None and is_well and readiness.can_start and not told)

    @property
    def _is_real(self) -> bool:
        """The robot is not known to be a simulated one."""
        return self._model.robot is not None and not is_simulated_robot(self._model.robot.status)

    @property
    def _unconfirmed(self) -> str:
        """What a person still has to say before a test on a real robot; empty when nothing."""
        if not self._is_real:
            return ""
        if not self.identity.given.identity.person_in_charge:
            return self.tr("Name the person in charge under Car, key and operator.")
        return "" if self.conditions.is_complete else self.tr("Confirm each operating condition below the parameters.")

    def _confirm(self) -> None:
        self._tell_wanted()
        self._judge()

    def _start(self) -> None:
        self.started.emit(self.form.parameters, self.given.paths, self.identity.given)
