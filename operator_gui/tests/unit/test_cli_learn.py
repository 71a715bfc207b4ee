"""`mtr-operator learn`: a person at the terminal, and a Car that does as the person does, on a clock of their own."""
# SPDX-License-Identifier: Apache-2.0
import argparse

import cantools
import pytest

from mtr_operator.car_link.adapter import AdapterSettings
from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.learn.command_line import learn_by
from mtr_operator.car_link.learn.database_names import bits_of
from mtr_operator.car_link.learn.listener import Listener
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.cli.commands import run_command
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, NothingLearned
from mtr_operator.domain.ports import LockState

CYCLE_S = 0.02


class Bench:
    """Adapter, Car and person. obeys: the Car does as it is told. lines: how often the person answers."""

    def __init__(self, obeys=True, lines=99, problem="", database=None):
        self.now_s, self.problem = 100.0, ""
        self._late_problem = problem
        self._obeys, self._lines = obeys, lines
        self._message = DemoLockMessage()
        self._heard = None
        self.stopped, self.is_dead = 0, False
        self.options = argparse.Namespace(prompts=4, database=database)

    def listen(self, heard):
        self._heard = heard
        return self

    def start(self):
        pass

    def stop(self):
        self.stopped += 1

    def wait(self, duration_s):
        end_s = self.now_s + duration_s
        while self.now_s < end_s:
            self.now_s += CYCLE_S
            if self.is_dead:
                continue
            self._heard(CanFrame(0x320, False, self._message.next(), self.now_s))

    def readline(self):
        if not self._lines:
            return ""
        self._lines -= 1
        self.problem = self._late_problem
        self.wait(0.5)
        if self._obeys:
            self._message.is_locked = not self._message.is_locked
        self.wait(0.5)
        return "\n"

    def learn(self, path):
        self.options.out = path
        learn_by(self.listen, self.options, self, lambda: self.now_s, self.wait)


def test_profile_is_written_and_said(tmp_path, capsys):
    bench = Bench()
    # The Car is unlocked when it is asked to be locked first.
    bench._message.is_locked = False
    bench.learn(tmp_path / "golf.yaml")
    told = capsys.readouterr()
    assert "1/4: lock the Car with its own key" in told.err
    assert "4/4: unlock the Car" in told.err
    assert "320" in told.out and "4/4" in told.out
    assert load_profile(str(tmp_path / "golf.yaml")).signal == "LockState"
    assert bench.stopped == 1


def test_dead_bus_is_told_before_the_first_prompt(tmp_path, capsys):
    bench = Bench()
    bench.is_dead = True
    with pytest.raises(NothingLearned, match="Nothing came over the bus in 5 s; check bit rate"):
        bench.learn(tmp_path / "golf.yaml")
    told = capsys.readouterr()
    assert "Listening for 5 s" in told.err and "1/4" not in told.err and told.out == ""
    assert bench.now_s < 106.0 and bench.stopped == 1


def test_bus_with_error_frames_alone_is_a_wrong_bit_rate():
    heard = []
    listener = Listener(AdapterSettings("virtual", "dead", 250_000), heard.append)
    for _ in range(30):
        assert len(heard) == 0
        listener.error_frame()
    assert "not one frame at 250000 bit/s: the bit rate is another one" in listener.problem
    listener.frame(CanFrame(0x320, False, b"", 0.0))
    assert listener.problem == "" and len(heard) == 1


def test_rate_of_the_frames_is_said_before_the_first_prompt(tmp_path, capsys):
    bench = Bench()
    bench._message.is_locked = False
    bench.learn(tmp_path / "golf.yaml")
    assert "Listening for 5 s; leave the Car alone.\n50 frames a second.\n1/4" in capsys.readouterr().err


def learned_with(database, folder):
    bench = Bench(database=database)
    bench._message.is_locked = False
    bench.learn(folder / "golf.yaml")
    return load_profile(str(folder / "golf.yaml"))


def test_message_and_signal_have_the_names_of_a_database(tmp_path, capsys):
    found = learned_with(PROFILE_FOLDER / "mtr_demo_car.dbc", tmp_path)
    shipped = load_profile("mtr_demo_car")
    told = capsys.readouterr()
    for words in (f"{shipped.message.name} {shipped.signal}", f"Message {shipped.message.name} tells"):
        assert words in told.out
    assert (found.message.name, found.signal) == (shipped.message.name, shipped.signal)
    known = (LockState.LOCKED, LockState.UNLOCKED)
    assert found.states == {raw: state for raw, state in shipped.states.items() if state in known}
    assert (found.alive_signal, found.command_signal) == (shipped.alive_signal, shipped.command_signal)
    assert [path.name for path in tmp_path.iterdir()] == ["golf.yaml"]


BIG_ENDIAN = """VERSION ""
NS_ :
BS_:
BU_: Car
BO_ 800 NO: 4 Car
 SG_ ON : 1|2@0+ (0.5,3) [0|0] "" Car
 SG_ REST : 15|24@0+ (1,0) [0|0] "" Car
"""


def test_signal_of_any_byte_order_scale_and_name_is_found(tmp_path):
    (tmp_path / "golf.dbc").write_text(BIG_ENDIAN)
    found = learned_with(tmp_path / "golf.dbc", tmp_path)
    # Raw values, whatever the scale; and the database is as it was.
    assert (found.message.name, found.signal) == ("NO", "ON")
    assert found.states == {0: LockState.LOCKED, 1: LockState.UNLOCKED}
    assert (tmp_path / "golf.dbc").read_text() == BIG_ENDIAN


def test_database_that_does_not_know_the_signal_is_told_and_left_alone(tmp_path, capsys):
    database = tmp_path / "other.dbc"
    database.write_text(BIG_ENDIAN.replace("BO_ 800", "BO_ 801"))
    assert learned_with(database, tmp_path).message.name == "Message_320"
    assert f"The CAN database {database} has no signal where it was found" in capsys.readouterr().err


@pytest.mark.parametrize(("content", "words"), [(None, "No such file"), ("garbage", "cannot be read")])
def test_database_that_cannot_be_read_is_refused_before_anything_is_asked(tmp_path, capsys, content, words):
    database = tmp_path / "bad.dbc"
    if content:
        database.write_text(content)
    assert run_command(["learn", "--out", str(tmp_path / "golf.yaml"), "--database", str(database)]) == 2
    told = capsys.readouterr().err.strip()
    assert words in told and "\n" not in told and not (tmp_path / "golf.yaml").exists()


@pytest.mark.parametrize(("entry", "order"), [("20|3@0+", "big"), ("5|12@0+", "big"), ("9|5@1+", "little")])
def test_bits_of_a_signal_are_those_that_it_sets(entry, order):
    text = BIG_ENDIAN.replace("1|2@0+ (0.5,3)", f"{entry} (1,0)")
    message = cantools.database.load_string(text, "dbc", strict=False).messages[0]
    signal = message.get_signal_by_name("ON")
    message.signals.remove(message.get_signal_by_name("REST"))
    message.refresh(strict=False)
    data = message.encode({"ON": (1 << signal.length) - 1}, strict=False)
    value = int.from_bytes(data, "little")
    assert bits_of(signal) == {bit for bit in range(32) if value >> bit & 1}


def test_car_that_does_nothing_leaves_no_file_and_a_sentence(tmp_path):
    with pytest.raises(NothingLearned, match="No bit of any message followed"):
        Bench(obeys=False).learn(tmp_path / "golf.yaml")
    assert not list(tmp_path.iterdir())


def test_end_of_the_input_is_said(tmp_path):
    bench = Bench(lines=2)
    with pytest.raises(InvalidParameter, match="needs a terminal"):
        bench.learn(tmp_path / "golf.yaml")
    assert bench.stopped == 1


def test_adapter_that_is_pulled_out_ends_it(tmp_path):
    with pytest.raises(ConnectionFailed, match="has failed"):
        Bench(problem="The CAN adapter has failed: gone.").learn(tmp_path / "golf.yaml")


def test_file_that_is_there_is_refused_before_anything_is_asked(tmp_path, capsys):
    (tmp_path / "golf.yaml").write_text("mine", encoding="utf-8")
    assert run_command(["learn", "--out", str(tmp_path / "golf.yaml")]) == 2
    assert "is there already; choose another name." in capsys.readouterr().err


@pytest.mark.parametrize(("arguments", "sentence"), [
    (["--can-interface", "nonsense"], "CAN interface is 'nonsense'"),
    (["--prompts", "7"], "allowed are even numbers from 4 to 40"),
    (["--can-interface", "slcan", "--can-channel", "/dev/no_such_thing"], "There is no CAN adapter at"),
])
def test_unsuitable_adapter_or_number_is_one_sentence(tmp_path, capsys, arguments, sentence):
    assert run_command(["learn", "--out", str(tmp_path / "golf.yaml"), *arguments]) == 2
    told = capsys.readouterr().err.strip()
    assert sentence in told and "\n" not in told
