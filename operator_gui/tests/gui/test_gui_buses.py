"""Further buses of the Car in the connection window and the settings: an adapter for each, by its name."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtTest import QTest

from mtr_operator.gui.forms.can_form import CanForm
from mtr_operator.gui.learn.adapter_loan import AdapterLoan
from mtr_operator.gui.windows.main_window import MainWindow
from mtr_operator.gui.windows.settings_window import SettingsWindow
from mtr_operator.station.connection import BusChoice, CanChoice, LinkOpener

DATABASE = 'VERSION ""\nBU_: GW\nBO_ 288 State: 1 GW\n SG_ Lock : 0|2@1+ (1,0) [0|3] "" GW\n'
PROFILE = ("database: car.dbc\nmessage: State\nsignal: Lock\nstates: {0: locked, 1: unlocked}\ncycle_time_s: 0.1\n"
           "buses: {body: car.dbc, doors: car.dbc}\n")
MISSING = "/dev/none"


@pytest.fixture(name="profile")
def profile_of_three_buses(tmp_path):
    """Path of a profile that declares two further buses."""
    (tmp_path / "car.dbc").write_text(DATABASE, encoding="utf-8")
    (tmp_path / "car.yaml").write_text(PROFILE, encoding="utf-8")
    return str(tmp_path / "car.yaml")


@pytest.fixture(name="real_buses")
def buses_of_the_library(opener, monkeypatch):
    """The Car's links are real ones."""
    monkeypatch.setattr(opener, "car", LinkOpener().car)


def choice_of(tmp_path, profile, doors=("virtual", "doors")):
    """Adapters on three buses."""
    interface, channel = doors
    return CanChoice("virtual", f"{tmp_path}", profile=profile, further=(
        BusChoice("body", "virtual", f"{tmp_path}body", 125_000), BusChoice("doors", interface, channel)))


@pytest.fixture(name="form")
def form_of_a_real_adapter(qapp, profile):
    """A form with an adapter and the profile."""
    form = CanForm()
    form.show_choice(CanChoice("socketcan", "can0", profile=profile))
    form.show()
    yield form
    form.deleteLater()


def test_form_shows_as_many_adapters_as_the_profile_has_buses(form, profile):
    assert [each.bus for each in form.further.shown] == ["body", "doors"]
    assert form.further.isVisible() and form.choice.further == ()
    form.profile.setCurrentText("mtr_demo_car")
    assert not form.further.isVisible() and form.further.shown == ()
    form.profile.setCurrentText("no such profile")
    assert not form.further.isVisible()
    form.profile.setCurrentText(profile)
    form.interface.setCurrentIndex(0)
    assert not form.further.isVisible() and form.choice is None


def test_each_bus_has_a_channel_and_a_name_of_its_own(form):
    for number, each in enumerate(form.further.shown, 1):
        fields = each.fields
        assert not fields.channel.isEnabled() and each.choice is None
        for interface, channel in (("socketcan", f"can{number}"), ("pcan", f"PCAN_USBBUS{number + 1}")):
            fields.interface.setCurrentIndex(fields.interface.findData(interface))
            assert each.choice == BusChoice(each.bus, interface, channel)
        assert fields.interface.findData("simulated") < 0
        assert all(each.bus in field.accessibleName() for field in fields.in_order)
    assert form.interface.accessibleName() == "CAN adapter"


def test_what_was_typed_for_a_bus_is_there_when_its_profile_is_chosen_again(form, profile):
    body = form.further.forms["body"].fields
    body.show_interface("slcan")
    body.show_adapter("/dev/ttyACM7", 125_000, 2_000_000)
    wanted = BusChoice("body", "slcan", "/dev/ttyACM7", 125_000, 2_000_000)
    assert form.choice.further == (wanted,)
    form.profile.setCurrentText("mtr_demo_car")
    assert form.choice.further == ()
    form.profile.setCurrentText(profile)
    assert form.choice.further == (wanted,)


def test_tabulator_goes_on_to_the_further_buses(form):
    form.activateWindow()
    form.normal.setFocus()
    QTest.keyClick(form.normal, Qt.Key_Tab)
    assert form.focusWidget() is form.further.forms["body"].fields.interface


@pytest.mark.usefixtures("real_buses")
def test_refusal_names_its_bus_and_stands_at_its_field(newcomer, profile, tmp_path):
    window = newcomer.window
    window.can.show_choice(choice_of(tmp_path, profile, ("slcan", MISSING)))
    newcomer.click(window.button)
    newcomer.wait(window.button.isEnabled)
    assert window.message.text() == "The CAN adapter of the bus doors cannot be used."
    assert window.detail.text().startswith(f"Further bus doors: There is no CAN adapter at {MISSING}")
    faults = {name: form.fields.channel.fault for name, form in window.can.further.forms.items()}
    assert faults == {"body": "", "doors": window.message.text()} and not window.can.channel.fault
    window.can.further.forms["doors"].fields.channel.show_text("/dev/other")
    assert not window.message.text() and not window.can.further.forms["doors"].fields.channel.fault


def test_pairing_stays_with_the_robot_beside_many_buses(newcomer, profile):
    window = newcomer.window
    window.resize(1024, 2000)
    window.can.show_choice(CanChoice("slcan", "/dev/x"))
    newcomer.wait(lambda: window.pairing.y() > window.can.normal.y())
    window.can.show_choice(CanChoice("slcan", "/dev/x", profile=profile))
    newcomer.wait(lambda: window.pairing.y() < window.can.normal.y())


@pytest.mark.usefixtures("real_buses")
def test_bus_without_an_adapter_is_refused_by_its_name(newcomer, profile, tmp_path):
    window = newcomer.window
    window.can.show_choice(CanChoice("virtual", f"{tmp_path}", profile=profile))
    newcomer.click(window.button)
    newcomer.wait(window.button.isEnabled)
    assert window.message.text() == "The CAN adapter of the bus body cannot be used."


@pytest.mark.usefixtures("real_buses")
def test_adapters_of_all_buses_are_remembered_and_shown_in_the_settings(newcomer, start, profile, tmp_path):
    wanted = choice_of(tmp_path, profile)
    newcomer.window.can.show_choice(wanted)
    newcomer.click(newcomer.window.button)
    newcomer.wait(lambda: isinstance(newcomer.window, MainWindow))
    flow = newcomer.application.flow
    settings = SettingsWindow(flow, newcomer.application.appearance, newcomer.window)
    settings.show()
    assert settings.can.choice == wanted
    settings.can.further.forms["doors"].show_choice(BusChoice("doors", "slcan", MISSING))
    newcomer.click(settings.use_can)
    newcomer.wait(lambda: settings.message.text().startswith("Further bus doors: There is no CAN adapter"))
    assert settings.can.further.forms["doors"].fields.channel.fault == settings.message.text()
    assert start().window.can.choice == wanted


def test_adapter_of_a_further_bus_is_lent_to_learn_with(form, profile, tmp_path):
    class Connecting:
        """Has adapters in use."""

        can_in_use = choice_of(tmp_path, profile)
        wanted = []

        class can_opened:
            connect = staticmethod(lambda _slot: None)

        def use_can(self, choice):
            self.wanted.append(choice)

    class Flow:
        """Of the window."""

        connecting = Connecting()

    loan = AdapterLoan(Flow())
    loan.take(CanChoice("virtual", f"{tmp_path}body"))
    loan.give_back()
    assert Connecting.wanted == [None, Connecting.can_in_use]
