"""The dialog that learns a Car: prompts answered by mouse, a bus that follows, and a profile that the form then has."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from fit_checks import assert_fits

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.learn.findings import findings_of
from mtr_operator.car_link.learn.learning import Learning
from mtr_operator.car_link.learn.recording import Recording, Stay
from mtr_operator.car_link.learn.session import DEFAULT_PROMPTS
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState
from mtr_operator.gui.learn.learn_window import LearnWindow
from mtr_operator.station.connection import CanChoice

CYCLE_S = 0.02


class Bus:
    """The adapter, and a Car on a clock of its own: each look of the window is a tenth of a second on it."""

    def __init__(self):
        self.now_s, self.problem, self.refusal = 0.0, "", ""
        self.message = DemoLockMessage()
        self.starts = self.stops = 0
        self._heard = None

    def listener(self, _choice, heard):
        self._heard = heard
        return self

    def start(self):
        self.starts += 1
        if self.refusal:
            raise ConnectionFailed(self.refusal)

    def stop(self):
        self.stops += 1

    def look(self):
        for _ in range(5):
            self.now_s += CYCLE_S
            self._heard(CanFrame(0x320, False, self.message.next(), self.now_s))
        return self.now_s


@pytest.fixture
def bus(opener, monkeypatch):
    made = Bus()
    opener.listener = made.listener
    monkeypatch.setattr("mtr_operator.gui.learn.learn_window.Learning",
                        lambda listen: Learning(listen, clock=made.look))
    return made


@pytest.fixture
def dialog(newcomer, bus, qtbot):
    """The dialog as the connection window opens it."""
    form = newcomer.window.can
    form.interface.setCurrentIndex(form.interface.findData("slcan"))
    newcomer.click(form.learn)
    made = next(each for each in newcomer.window.findChildren(LearnWindow))
    made._timer.setInterval(1)
    return made


def answer_all(newcomer, dialog, bus, obeys=True):
    newcomer.click(dialog.act)
    for number in range(1, DEFAULT_PROMPTS + 1):
        newcomer.wait(lambda number=number: dialog.what.text().startswith(f"{number} of") and dialog.act.isEnabled())
        if obeys:
            bus.message.is_locked = dialog._learning.session.wanted is LockState.LOCKED
        for _ in range(3):
            bus.look()
        newcomer.click(dialog.act)


def test_person_who_does_as_asked_gets_a_profile_in_the_form(newcomer, dialog, bus):
    form = newcomer.window.can
    answer_all(newcomer, dialog, bus)
    newcomer.wait(dialog.name.isVisible)
    assert dialog.what.text() == "The message 320 tells the locks."
    assert dialog.table.model().rowCount() == 1
    assert not dialog.keep.isEnabled()
    dialog.name.show_text("golf")
    newcomer.click(dialog.keep)
    profile = load_profile(form.profile.currentText())
    assert (profile.name, profile.alive_signal, profile.command_signal) == ("golf", "AliveCounter", "ChangeCounter")
    assert form.choice.profile == str(newcomer.application.flow.store.profile_folder / "golf.yaml")
    assert bus.stops >= 1


def test_database_names_what_followed_and_the_profile_refers_to_it(newcomer, dialog, bus, monkeypatch, tmp_path):
    form = newcomer.window.can
    answer_all(newcomer, dialog, bus)
    newcomer.wait(dialog.database.isVisible)
    (tmp_path / "bad.dbc").write_text("garbage")
    for chosen in (tmp_path / "bad.dbc", PROFILE_FOLDER / "mtr_demo_car.dbc"):
        monkeypatch.setattr(dialog.database, "_ask", lambda *_, chosen=chosen: chosen)
        newcomer.click(dialog.database.choose)
        assert ("cannot be read" in dialog.database.field.fault) is (chosen.name == "bad.dbc")
    table = dialog.table.model()
    shipped = load_profile("mtr_demo_car")
    assert f"{shipped.message.name} {shipped.signal}" in table.index(0, table.columnCount() - 1).data()
    dialog.name.show_text("golf")
    newcomer.click(dialog.keep)
    assert load_profile(form.profile.currentText()).signal == shipped.signal
    assert not list(newcomer.application.flow.store.profile_folder.glob("*.dbc"))


def test_name_that_is_taken_is_said_at_the_field(newcomer, dialog, bus):
    folder = newcomer.application.flow.store.profile_folder
    folder.mkdir()
    (folder / "golf.yaml").write_text("mine", encoding="utf-8")
    answer_all(newcomer, dialog, bus)
    newcomer.wait(dialog.name.isVisible)
    dialog.name.show_text("golf")
    newcomer.click(dialog.keep)
    assert dialog.name.fault.endswith("is there already; choose another name.")
    assert dialog.isVisible()


def test_car_that_does_not_follow_is_said_and_it_can_begin_again(newcomer, dialog, bus):
    answer_all(newcomer, dialog, bus, obeys=False)
    newcomer.wait(lambda: "No bit of any message followed" in dialog.note.text())
    assert dialog.act.isEnabled() and dialog.act.text() == "Begin"
    answer_all(newcomer, dialog, bus)
    newcomer.wait(dialog.name.isVisible)


def test_adapter_that_cannot_be_opened_is_said(newcomer, dialog, bus):
    bus.refusal = "There is no CAN adapter at /dev/ttyACM0; check the channel and the USB plug."
    newcomer.click(dialog.act)
    newcomer.wait(lambda: dialog.note.text() == bus.refusal)
    assert dialog.act.isEnabled()


def test_adapter_that_is_pulled_out_is_said(newcomer, dialog, bus):
    newcomer.click(dialog.act)
    newcomer.wait(lambda: bus.starts)
    bus.problem = "The CAN adapter has failed: gone."
    newcomer.wait(lambda: dialog.note.text() == bus.problem)
    assert bus.stops >= 1


def test_closing_lets_the_adapter_go(newcomer, dialog, bus):
    newcomer.click(dialog.act)
    newcomer.wait(lambda: bus.starts)
    dialog.reject()
    newcomer.wait(lambda: bus.stops)


@pytest.mark.parametrize("is_left_by_settings", [False, True])
def test_adapter_of_the_open_link_is_lent_and_given_back(operator, bus, is_left_by_settings):
    flow = operator.application.flow
    operator.window.show_settings()
    settings = operator.window._opened[next(iter(operator.window._opened))]
    settings.can.interface.setCurrentIndex(settings.can.interface.findData("slcan"))
    settings.can.channel.show_text("/dev/ttyACM7")
    operator.click(settings.use_can)
    operator.wait(lambda: getattr(flow.connecting.can_in_use, "channel", "") == "/dev/ttyACM7")
    operator.click(settings.can.learn)
    dialog = next(each for each in settings.findChildren(LearnWindow))
    operator.click(dialog.act)
    operator.wait(lambda: bus.starts)
    assert flow.connecting.can_in_use is None
    (settings if is_left_by_settings else dialog).reject()
    operator.wait(lambda: bus.stops)
    operator.wait(lambda: getattr(flow.connecting.can_in_use, "channel", "") == "/dev/ttyACM7")


def test_learning_rests_while_a_test_runs(operator):
    operator.begin()
    operator.window.show_settings()
    settings = operator.window._opened[next(iter(operator.window._opened))]
    assert not settings.can.learn.isEnabled()


def two_followers():
    """What a short recording of locks and lights shows."""
    recording, message, lights = Recording(), DemoLockMessage(), 0
    for step in range(800):
        message.is_locked, lights = step // 200 % 2 == 0, (step - 20) // 200 % 2
        recording.frame(CanFrame(0x320, False, message.next(), step * CYCLE_S))
        recording.frame(CanFrame(0x18DA10F1, True, bytes([lights]), step * CYCLE_S))
    for number, state in enumerate(2 * (LockState.LOCKED, LockState.UNLOCKED)):
        recording.stays.append(Stay(state, 4.0 * number - 0.1, 4.0 * number + 1.0, 4.0 * number + 3.9))
    return findings_of(recording)


def test_every_stage_fits(application, show, monkeypatch):
    window = show(lambda: LearnWindow(application.flow, CanChoice("slcan", "/dev/ttyACM0"),
                                      application.flow.store.profile_folder))
    assert_fits(window, monkeypatch)
    window._give_up("No bit of any message followed all prompts; repeat it, and act only when asked. A Car that tells "
                    "its locks on another bus cannot be learned from this one.")
    assert_fits(window, monkeypatch)
    window._show_findings(two_followers())
    assert window.table.model().rowCount() == 2
    assert_fits(window, monkeypatch)
