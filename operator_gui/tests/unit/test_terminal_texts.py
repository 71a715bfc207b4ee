"""Texts of received files on the terminal: no control character, and no line of their own."""
# SPDX-License-Identifier: Apache-2.0
import io

import pytest

from mtr_operator.cli import main
from mtr_operator.cli.display import Display
from mtr_operator.terminal import show

HOSTILE = "\x1b]0;evil\x07\u202e$x$<b>\x9b31m"
# As YAML writes them.
QUOTED = '"\\e]0;evil\\a\\u202e$x$<b>\\x9b31m\\nverdict: pass"'
PROFILE = f"database: mtr_demo_car.dbc\nmessage: {QUOTED}\nsignal: LockState\nstates: {{0: locked, 1: unlocked}}\n"


def printed(capsys):
    captured = capsys.readouterr()
    return captured.out + captured.err


@pytest.mark.parametrize("content", [
    PROFILE, f"{QUOTED}: 1\n", f"database: {QUOTED}\n", f"- {QUOTED}\n",
    f"database: mtr_demo_car.dbc\nmessage: DoorLockStatus\nsignal: {QUOTED}\n"],
    ids=["message", "entry", "database", "list", "signal"])
def test_profile_of_a_stranger_is_refused_on_one_line(tmp_path, capsys, content):
    path = tmp_path / "car.yaml"
    path.write_text(content, encoding="utf-8")
    assert main(["try", str(path)])
    text = printed(capsys)
    assert text.count("\n") == 1 and text[:-1].isprintable()


@pytest.mark.parametrize("content", [f"{QUOTED}: 1\n", f"method: {QUOTED}\n", f"minimum_distance_m: {QUOTED}\n"],
                         ids=["name", "choice", "number"])
def test_parameters_of_a_stranger_are_refused_on_one_line(tmp_path, capsys, content):
    path = tmp_path / "parameters.yaml"
    path.write_text(content, encoding="utf-8")
    assert main(["plan", "key_press", "--params", str(path)])
    text = printed(capsys)
    assert text.count("\n") == 1 and text[:-1].isprintable()


@pytest.mark.parametrize("content", [f"requirements: [{{name: {QUOTED}}}]\n", f"{QUOTED}: 2\n"], ids=["name", "entry"])
def test_limits_of_a_stranger_are_refused_on_one_line(tmp_path, capsys, content):
    path, parameters = tmp_path / "limits.yaml", tmp_path / "parameters.yaml"
    path.write_text(content, encoding="utf-8")
    parameters.write_text("minimum_distance_m: 3.0\n")
    assert main(["plan", "key_press", "--params", str(parameters), "--limits", str(path)])
    text = printed(capsys)
    assert text.count("\n") == 1 and text[:-1].isprintable()


def test_log_with_control_characters_is_named_without_them(tmp_path, capsys):
    path, parameters = tmp_path / "bus.asc", tmp_path / "parameters.yaml"
    parameters.write_text("passes: 1\n")
    path.write_bytes(b"date Sat Nov 28 10:00:00 2026\nbase hex timestamps absolute\n0.1 \x00\x1b[31m 1 d 8\n")
    assert main(["run", "autolock", "--params", str(parameters), "--simulated-robot", "--can-log", str(path),
                 "--car-profile", "mtr_demo_car", "--out", str(tmp_path / "out")])
    lines = printed(capsys).split("\n")
    assert len(lines) > 1 and all(line.isprintable() for line in lines)


def test_display_shows_each_line_without_control_characters():
    stream = io.StringIO()
    Display(None, stream).say(f"first {HOSTILE}\nsecond")
    first, second, end = stream.getvalue().split("\n")
    assert first.isprintable() and first.startswith("first ") and (second, end) == ("second", "")


def test_text_is_shown_whole_if_it_is_printable(capsys):
    show("22.5 °C, Türe, \N{CJK UNIFIED IDEOGRAPH-8ECA}")
    assert capsys.readouterr().out == "22.5 °C, Türe, \N{CJK UNIFIED IDEOGRAPH-8ECA}\n"
