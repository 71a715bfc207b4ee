"""The connection window."""
# SPDX-License-Identifier: Apache-2.0
import threading

import pytest
from PyQt5.QtCore import Qt, QTimer

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.gui.windows.connection_window import ConnectionWindow
from mtr_operator.gui.windows.main_window import MainWindow
from mtr_operator.robot_link.fake import FakeRobotLink

INVALID = "The IP address or port provided is invalid."
FAILED = "Connection failed, check the parameters."


@pytest.mark.parametrize(("field", "text", "part"), [
    ("host", "", "address"), ("host", "300.1.1.1", "four numbers from 0 to 255"), ("host", "a b", "host name"),
    ("subscriber_port", "", "subscriber port"), ("subscriber_port", "abc", "whole number"),
    ("publisher_port", "-1", "1 to 65535"), ("publisher_port", "70000", "1 to 65535"),
    ("publisher_port", "3334", "two different"),
])
def test_invalid_address_or_port_is_told_at_the_field_and_nothing_is_tried(newcomer, opener, field, text, part):
    window = newcomer.window
    getattr(window.robot, field).edit.setText(text)
    newcomer.click(window.button)
    assert window.message.text() == INVALID
    faults = [each.fault for each in (window.robot.host, window.robot.subscriber_port, window.robot.publisher_port)]
    assert any(part in fault for fault in faults), faults
    assert window.button.isEnabled()
    assert not opener.sent


def test_refused_connection_says_so_and_why(newcomer, opener):
    opener.robot_refusal = "Nothing listens on the subscriber port."
    window = newcomer.window
    newcomer.click(window.button)
    newcomer.wait(window.button.isEnabled)
    assert window.message.text() == FAILED
    assert window.detail.text() == opener.robot_refusal
    opener.robot_refusal = ""
    newcomer.connect()
    assert isinstance(newcomer.window, MainWindow)


def test_can_adapter_that_cannot_be_opened_is_not_taken_for_the_robot(newcomer, opener):
    opener.car_refusal = "There is no CAN adapter at /dev/ttyACM0; check the channel and the USB plug."
    window = newcomer.window
    window.can.interface.setCurrentIndex(window.can.interface.findData("slcan"))
    newcomer.click(window.button)
    newcomer.wait(window.button.isEnabled)
    assert window.message.text() == "The CAN adapter cannot be used."
    assert window.detail.text() == opener.car_refusal


def test_refusal_goes_when_its_field_is_put_right__B18(newcomer, opener):
    window = newcomer.window
    window.robot.host.edit.setText("300.1.1.1")
    newcomer.click(window.button)
    assert window.message.text() == INVALID
    window.robot.host.edit.setText("10.0.0.7")
    assert not window.message.text() and not window.robot.host.fault
    opener.car_refusal = "There is no CAN adapter at /dev/ttyACM0; check the channel and the USB plug."
    window.can.interface.setCurrentIndex(window.can.interface.findData("slcan"))
    newcomer.click(window.button)
    newcomer.wait(window.button.isEnabled)
    assert window.can.channel.fault == "The CAN adapter cannot be used."
    window.can.channel.edit.setText("/dev/ttyACM1")
    assert not window.can.channel.fault and not window.message.text() and not window.detail.text()


def test_language_is_chosen_in_the_connection_window_and_what_was_typed_stays__B19(newcomer):
    former = newcomer.window
    former.robot.host.edit.setText("10.0.0.7")
    former.can.interface.setCurrentIndex(former.can.interface.findData("slcan"))
    former.can.channel.edit.setText("/dev/ttyACM7")
    former.language.setCurrentIndex(former.language.findData("cs"))
    newcomer.wait(lambda: newcomer.window is not former)
    window = newcomer.window
    assert window.button.text() == "P\u0159ipojit"
    assert (window.robot.host.text, window.can.choice.channel) == ("10.0.0.7", "/dev/ttyACM7")
    assert newcomer.application.flow.store.settings.language == "cs"
    newcomer.application.language.use("en")


def test_enter_connects(newcomer):
    newcomer.bot.keyClick(newcomer.window.robot.host.edit, Qt.Key_Return)
    newcomer.wait(lambda: isinstance(newcomer.window, MainWindow))


def test_window_opens_with_the_focus_where_enter_connects(newcomer):
    newcomer.bot.keyClick(newcomer.window.focusWidget(), Qt.Key_Return)
    newcomer.wait(lambda: isinstance(newcomer.window, MainWindow))


def test_window_lives_while_connecting_takes_long(newcomer, opener):
    opener.connecting.clear()
    window, turns = newcomer.window, []
    newcomer.click(window.button)
    assert not window.button.isEnabled()
    QTimer.singleShot(0, lambda: turns.append(1))
    newcomer.wait(lambda: turns)
    assert newcomer.window is window
    opener.connecting.set()
    newcomer.wait(lambda: newcomer.window is not window)


@pytest.mark.parametrize("field", ["host", "subscriber_port", "publisher_port"])
def test_click_on_a_label_focuses_its_field(newcomer, field):
    window = newcomer.window
    window.button.setFocus()
    newcomer.bot.mouseClick(getattr(window.robot, field).label, Qt.LeftButton)
    assert window.focusWidget() is getattr(window.robot, field).edit


def test_last_success_is_filled_in_at_the_next_start(newcomer, start):
    newcomer.window.robot.host.edit.setText("127.0.0.7")
    newcomer.window.robot.subscriber_port.edit.setText("4444")
    newcomer.connect()
    window = start().window
    assert isinstance(window, ConnectionWindow)
    assert window.robot.host.text == "127.0.0.7"
    assert window.robot.subscriber_port.text == "4444"
    assert window.can.choice.interface == "simulated"


def test_failure_is_not_remembered(newcomer, opener, start):
    opener.robot_refusal = "Nothing listens there."
    newcomer.window.robot.host.edit.setText("127.0.0.9")
    newcomer.click(newcomer.window.button)
    newcomer.wait(newcomer.window.button.isEnabled)
    assert start().window.robot.host.text == "127.0.0.1"


def test_without_can_adapter_everything_but_a_test_works(newcomer):
    window = newcomer.window
    window.can.interface.setCurrentIndex(0)
    newcomer.click(window.button)
    newcomer.wait(lambda: newcomer.model.robot is not None)
    screen = newcomer.choose("autolock")
    newcomer.wait(lambda: "Not ready" in newcomer.window.header.status.text())
    assert not screen.start.isEnabled()
    assert "No CAN adapter is chosen." in newcomer.window.header.status.toolTip()


def test_driver_settings_follow_the_interface(newcomer):
    can = newcomer.window.can
    can.interface.setCurrentIndex(can.interface.findData("pcan"))
    assert can.channel.text == "PCAN_USBBUS1"
    can.interface.setCurrentIndex(can.interface.findData("socketcan"))
    assert can.channel.text == "can0"
    can.channel.edit.setText("can7")
    can.interface.setCurrentIndex(can.interface.findData("slcan"))
    assert can.channel.text == "can7"
    assert can.choice.bitrate_bps == 500_000
    assert can.choice.profile == "mtr_demo_car"


def test_code_is_typed_once_and_the_window_lives_meanwhile(newcomer, opener):
    window, asked, go_on = newcomer.window, [], threading.Event()

    def pair(host, code):
        go_on.wait(10.0)
        asked.append((host, code))
        return "controller"
    opener.pair = pair
    window.robot.host.edit.setText(" 10.42.0.1 ")
    window.pairing.code.edit.setText("123 456")
    newcomer.click(window.pairing.button)
    assert not window.pairing.button.isEnabled() and "10.42.0.1" in window.pairing.said.text()
    assert window.button.isEnabled()
    go_on.set()
    newcomer.wait(window.pairing.button.isEnabled)
    assert asked == [("10.42.0.1", "123 456")]
    assert window.pairing.said.text() == "Paired: this laptop may control the robot."
    assert not window.pairing.code.text
    opener.pair = lambda _host, _code: "viewer"
    assert window.focusWidget() is window.pairing.code.edit
    newcomer.bot.keyClick(window.pairing.code.edit, Qt.Key_Return)
    newcomer.wait(lambda: window.pairing.said.text() == "Paired: this laptop may look at the robot.")


def test_refused_pairing_is_told_at_its_field(newcomer, opener):
    window = newcomer.window

    def pair(_host, _code):
        raise ConnectionFailed("The code is wrong; the robot allows a few tries, each a little later.")
    opener.pair = pair
    window.pairing.code.edit.setText("123456")
    newcomer.click(window.pairing.button)
    newcomer.wait(lambda: window.pairing.code.fault)
    assert window.pairing.code.fault.startswith("The code is wrong") and window.pairing.button.isEnabled()
    assert not window.pairing.said.isVisible()
    window.pairing.code.edit.setText("1")
    assert not window.pairing.code.fault


def test_pairing_has_names_for_who_does_not_see_it(newcomer):
    form = newcomer.window.pairing
    assert form.code.edit.accessibleName() == "Pairing code" and "6 digits" in form.code.edit.accessibleDescription()
    assert form.button.text() == "Pair" and form.unencrypted.text() == "Without encryption"


def test_without_encryption_is_a_choice_that_is_warned_of_and_not_remembered(newcomer, opener):
    window, chosen = newcomer.window, []
    made = opener.robot
    opener.robot = lambda choice: chosen.append(choice.is_unencrypted) or made(choice)
    assert not window.pairing.warning.isVisible()
    window.pairing.unencrypted.setChecked(True)
    assert window.pairing.warning.isVisible() and window.typed.robot.is_unencrypted
    newcomer.connect()
    assert chosen[0] is True
    assert not newcomer.application.flow.store.settings.connection.robot.is_unencrypted


def test_exposed_link_is_red_in_the_header_and_a_local_one_is_not(newcomer, monkeypatch):
    is_exposed = [True]
    monkeypatch.setattr(FakeRobotLink, "is_exposed", property(lambda _link: is_exposed[0]))
    newcomer.connect()
    header = newcomer.window.header
    newcomer.wait(header.exposed.isVisible)
    assert header.exposed.property("role") == "banner" and "can move the robot" in header.link.toolTip()
    is_exposed[0] = False
    newcomer.wait(lambda: not header.exposed.isVisible())
    assert header.link.toolTip() == "The link to the robot is not encrypted."
