"""What a computer lacks is said in sentences, each with what to do, and by the exit code."""
# SPDX-License-Identifier: Apache-2.0
import builtins
import dataclasses

import pytest

from mtr_operator.cli import main
from mtr_operator.doctor import command_line
from mtr_operator.doctor.computer import PACKAGES, Computer, computer_findings
from mtr_operator.doctor.files import file_findings
from mtr_operator.station.checks.finding import State
from mtr_operator.station.settings import Settings
from mtr_operator.station.settings_file import SettingsStore


@pytest.fixture
def store(tmp_path):
    made = SettingsStore(tmp_path / "settings.json")
    made.change(dataclasses.replace(Settings(), result_folder=tmp_path / "new" / "results",
                                    progress_folder=tmp_path / "new" / "progress"))
    return made


@pytest.fixture
def computer(tmp_path):
    (tmp_path / "dev").mkdir()
    return Computer({"DISPLAY": ":0"}, "linux", tmp_path, lambda module: True, lambda path: True)


def findings(computer, store):
    return [*computer_findings(computer), *file_findings(store)]


def missing(computer, store):
    return {each.what: each.sentence for each in findings(computer, store) if each.state is State.BAD}


def test_computer_with_everything_lacks_nothing_and_keeps_no_folder(computer, store, tmp_path):
    assert missing(computer, store) == {}
    assert not (tmp_path / "new").exists()


def test_contract_that_does_not_fit_its_protobuf_is_told(computer, store):
    spoilt = dataclasses.replace(computer, import_problem=lambda module: f"{module}: no runtime_version")
    sentence = missing(spoilt, store)["contract"]
    assert "(mtr_proto.robot_link_pb2: no runtime_version); pip install mtr_proto again" in sentence
    assert dataclasses.replace(computer).import_problem("no_such_module") == "No module named 'no_such_module'"


def test_packages_contract_and_window_are_named(computer, store):
    lacking = dataclasses.replace(computer, is_installed=lambda module: module not in ("zmq", "PyQt5", "mtr_proto"))
    found = missing(lacking, store)
    assert found["packages"] == "Not installed: pyzmq; pip install them."
    assert "pip install the folder proto" in found["contract"] and "pip install PyQt5" in found["window"]


def test_every_declared_package_is_looked_for():
    declared = {"cantools", "matplotlib", "numpy", "platformdirs", "protobuf", "pynacl", "pyserial", "python-can",
                "pyyaml", "pyzmq", "scipy", "tqdm", "uncertainties"}
    assert set(PACKAGES.values()) == declared


def test_display_adapters_and_permissions_are_named(computer, store, tmp_path):
    assert "no display" in missing(dataclasses.replace(computer, environment={}), store)["display"]
    assert missing(dataclasses.replace(computer, environment={}, platform="win32"), store) == {}
    (tmp_path / "dev" / "ttyACM0").write_bytes(b"")
    (tmp_path / "sys" / "class" / "net" / "can0").mkdir(parents=True)
    (tmp_path / "sys" / "class" / "net" / "can0" / "operstate").write_text("down\n", encoding="utf-8")
    found = missing(dataclasses.replace(computer, may_use=lambda path: False), store)
    assert "dialout" in found["serial port"] and "ip link set can0 up" in found["CAN network"]


def test_computer_without_an_adapter_is_told_so_and_lacks_nothing(computer, store):
    [note] = [each for each in findings(computer, store) if each.state is State.NOTE]
    assert "None is plugged in" in note.sentence


def test_files_that_cannot_be_used_are_named(computer, store, tmp_path):
    (tmp_path / "new").write_bytes(b"a file in the way")
    (tmp_path / "laboratory.yaml").write_text("required: [car]\n", encoding="utf-8")
    found = missing(computer, store)
    assert set(found) == {"folder of results", "folder of progress", "laboratory"}
    assert found["laboratory"].startswith("No test can start.")
    (tmp_path / "settings.json").write_text("{", encoding="utf-8")
    assert "were not used" in missing(computer, SettingsStore(tmp_path / "settings.json"))["settings"]


def test_exit_code_is_2_when_something_is_missing(computer, store, monkeypatch, capsys):
    monkeypatch.setattr(command_line, "SettingsStore", lambda path: store)
    assert command_line.doctor(computer)
    assert capsys.readouterr().out.endswith("Nothing is missing.\n")
    assert not command_line.doctor(dataclasses.replace(computer, environment={}))
    monkeypatch.setattr("mtr_operator.cli.commands.doctor", lambda: False)
    assert main(["doctor"]) == 2


def test_without_a_package_every_command_ends_with_a_sentence_and_not_with_a_traceback(monkeypatch, capsys):
    def refuse(name, *rest, **more):
        if name.endswith("commands"):
            raise ModuleNotFoundError("No module named 'zmq'", name="zmq")
        return former(name, *rest, **more)
    former = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", refuse)
    assert main(["doctor"]) == 2
    assert "The package zmq is not installed" in capsys.readouterr().err
