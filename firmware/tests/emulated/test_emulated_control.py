"""The emulator's command line, control socket and real time."""
# SPDX-License-Identifier: Apache-2.0
import os
import select
import subprocess

import pytest
from serial_host import NEGOTIATE, STATE, frame, split

from mtr_emulator import Emulator, EmulatorError
from mtr_emulator.emulator import BINARY

TIMEOUT_S = 30.0


@pytest.mark.parametrize(("words", "sentence"), [
    ([], "--elf, --mcu, --pty and --control are needed."),
    (["--speed", "2"], "There is no option --speed."),
    (["--seed"], "--seed lacks a value."),
    (["--quantum-us", "fast"], "--quantum-us was fast"),
    (["--quantum-us", "1"], "--quantum-us was 1; allowed is 50"),
])
def test_wrong_command_line_is_refused_with_a_sentence(words, sentence):
    done = subprocess.run([str(BINARY), *words], text=True, capture_output=True, check=False, timeout=TIMEOUT_S)
    assert done.returncode == 2 and done.stderr.startswith(sentence)


def test_missing_firmware_and_unknown_microcontroller_are_said(tmp_path):
    for options, sentence in (({"mcu": "atmega2560", "elf": tmp_path / "none.elf"}, "cannot be read"),
                              ({"mcu": "z80"}, "no wiring for the microcontroller z80")):
        with pytest.raises(EmulatorError, match=sentence), Emulator(**options):
            pass


def test_wrong_questions_get_a_sentence():
    with Emulator("atmega328p", stepped=True) as board:
        for question, sentence in (("dance", "There is no command dance."), ('fault "x"', "There is no fault ?x?."),
                                   ("step", "step needs a time"), ("step 1000 5", "have not arrived")):
            with pytest.raises(EmulatorError) as refused:
                board._ask(question)
            assert sentence in str(refused.value)
        assert board.step(1000)["time_us"] == 1000


def test_stepping_is_refused_in_real_time():
    with Emulator("atmega328p") as board, pytest.raises(EmulatorError):
        board.step(1000)


def test_port_answers_in_real_time():
    with Emulator("atmega328p") as board:
        port = os.open(str(board.pty), os.O_RDWR | os.O_NOCTTY)
        os.write(port, frame(NEGOTIATE))
        received, topics = bytearray(), set()
        while STATE not in topics and select.select([port], [], [], TIMEOUT_S)[0]:
            received += os.read(port, 4096)
            topics |= {topic for topic, _ in split(received)}
        os.close(port)
        assert STATE in topics and board.probe().time_us > 0
