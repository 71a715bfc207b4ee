"""Values of a form, and settings that survive a restart."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import json
import pathlib
import sys

import pytest

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.connection import BusChoice, CanChoice, Connection, RobotChoice
from mtr_operator.station.number_text import Fault, parse_number, read, shown_number, written
from mtr_operator.station.settings import REMEMBERED_CARS, Settings
from mtr_operator.station.settings_file import SettingsStore, default_path, former_path

KEY_PRESS = SCENARIOS["key_press"].parameters_type.declarations()


@pytest.mark.parametrize(("text", "value"), [
    ("1.5", 1.5), ("1,5", 1.5), (" 2 ", 2.0), (",5", 0.5), ("-3", -3.0), ("1e2", 100.0), ("1,2,3", None), ("", None),
    ("nan", None), ("inf", None), ("0x10", None), ("1 m", None), ("1_0", None)])
def test_number_with_comma_or_point(text, value):
    assert parse_number(text) == value


@pytest.mark.parametrize(("name", "text", "fault"), [
    ("attempts", "1.5", Fault.NOT_WHOLE), ("attempts", "0", Fault.OUT_OF_RANGE), ("attempts", "", Fault.EMPTY),
    ("maximum_distance_m", "1e300", Fault.OUT_OF_RANGE), ("maximum_distance_m", "x", Fault.NOT_A_NUMBER),
    ("key_height_m", "34", Fault.OUT_OF_RANGE), ("key_height_m", "35", None), ("maximum_speed_mps", "7,2", None)])
def test_faults_of_a_field(name, text, fault):
    assert read(KEY_PRESS[name], text).fault is fault


def test_values_survive_being_shown_and_read():
    for declared in KEY_PRESS.values():
        for limit in (declared.low, declared.high, declared.default):
            value = declared.to_si(int(limit) if declared.is_integer else limit)
            reading = read(declared, written(shown_number(declared, value), ","))
            assert reading.fault is None
            assert reading.value == pytest.approx(value, rel=1e-5)


def test_settings_survive_a_restart(tmp_path):
    store = SettingsStore(tmp_path / "deep" / "settings.json")
    further = (BusChoice("body", "slcan", "/dev/y", 125_000), BusChoice("doors", "pcan", "USB2", 500_000, 2_000_000))
    connection = Connection(RobotChoice("10.0.0.7", 5, 6),
                            CanChoice("slcan", "/dev/x", 250_000, "other", further=further))
    wanted = dataclasses.replace(Settings(), theme="dark", language="cs", unfinished=tmp_path / "p.json") \
        .with_connection(connection).with_parameters("autolock", {"clearance_m": 0.4})
    store.change(wanted)
    assert store.problem == ""
    later = SettingsStore(tmp_path / "deep" / "settings.json")
    later.load()
    assert later.settings == wanted


def test_settings_of_one_bus_are_read_as_before(tmp_path):
    store = SettingsStore(tmp_path / "settings.json")
    store.change(Settings().with_connection(Connection(can=CanChoice("slcan", "/dev/x"))))
    document = json.loads((tmp_path / "settings.json").read_text(encoding="utf-8"))
    assert document["version"] == 1 and document["connection"]["can"].pop("further") == []
    (tmp_path / "settings.json").write_text(json.dumps(document), encoding="utf-8")
    later = SettingsStore(tmp_path / "settings.json")
    later.load()
    assert (later.problem, later.settings) == ("", store.settings)


@pytest.mark.parametrize("further", [5, "body", [5], [{"bus": "body"}], [{"bus": 1, "interface": "slcan"}],
                                     [{"bus": "body", "interface": "slcan", "bitrate_bps": "fast"}]])
def test_damaged_further_buses_are_refused(tmp_path, further):
    document = Settings().with_connection(Connection(can=CanChoice("slcan"))).to_document()
    document["connection"]["can"]["further"] = further
    (tmp_path / "settings.json").write_text(json.dumps(document), encoding="utf-8")
    store = SettingsStore(tmp_path / "settings.json")
    store.load()
    assert "They are damaged." in store.problem


def test_cars_are_remembered_by_their_vin_newest_first_without_notes(tmp_path):
    store = SettingsStore(tmp_path / "settings.json")
    golf = Identity("WVW1", "Golf", key_serial="0042", operator="J. Novak", notes="Rain.")
    settings = store.settings.with_car(golf).with_car(Identity("TMB2", "Octavia"))
    settings = settings.with_car(Identity(operator="E. Kral"))
    store.change(settings.with_car(dataclasses.replace(golf, key_serial="0043")))
    later = SettingsStore(tmp_path / "settings.json")
    later.load()
    assert later.settings.cars == (Identity("WVW1", "Golf", key_serial="0043"), Identity("TMB2", "Octavia"))
    for number in range(2 * REMEMBERED_CARS):
        settings = settings.with_car(Identity(f"VIN{number}"))
    assert len(settings.cars) == REMEMBERED_CARS
    assert settings.cars[0].car_vin == f"VIN{2 * REMEMBERED_CARS - 1}"


def test_hosts_are_remembered_newest_first_and_once():
    settings = Settings()
    for host in ("a", "b", "a"):
        settings = settings.with_connection(Connection(RobotChoice(host)))
    assert settings.hosts == ("a", "b")


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"format": "mtr-operator settings", "version": 2}', "null"])
def test_bad_settings_leave_the_defaults_and_the_file(tmp_path, text):
    path = tmp_path / "settings.json"
    path.write_text(text, encoding="utf-8")
    store = SettingsStore(path)
    store.load()
    assert store.settings == Settings()
    assert "were not used" in store.problem
    assert path.read_text(encoding="utf-8") == text


def test_unusable_settings_are_laid_aside_before_anything_is_kept(tmp_path):
    path = tmp_path / "settings.json"
    for text in ('{"comma": too many,}', '{"format": "mtr-operator settings", "version": 2}'):
        path.write_text(text, encoding="utf-8")
        store = SettingsStore(path)
        store.load()
        store.change(Settings(theme="dark"))
        store.change(Settings(theme="light"))
        later = SettingsStore(path)
        later.load()
        assert (store.problem, later.problem, later.settings.theme) == ("", "", "light")
    names = sorted(each.name for each in tmp_path.iterdir())
    assert names == ["settings.json", "settings.json.bad", "settings.json.bad1"]
    assert (tmp_path / "settings.json.bad").read_text(encoding="utf-8") == '{"comma": too many,}'


def test_each_damaged_entry_is_refused(tmp_path):
    path = tmp_path / "settings.json"
    whole = Settings().to_document()
    for name in set(whole) - {"unfinished"}:
        path.write_text(json.dumps({**whole, name: 5}), encoding="utf-8")
        store = SettingsStore(path)
        store.load()
        assert store.problem, name


def test_settings_of_an_earlier_version_are_moved_to_their_new_place_once(tmp_path):
    former, path = tmp_path / "old" / "settings.json", tmp_path / "new" / "settings.json"
    SettingsStore(former).change(Settings(theme="dark"))
    store = SettingsStore(path, former)
    store.load()
    assert (store.settings.theme, store.problem) == ("dark", "")
    assert path.exists() and not former.exists()
    SettingsStore(former).change(Settings(theme="light"))
    later = SettingsStore(path, former)
    later.load()
    assert later.settings.theme == "dark"


def test_settings_that_cannot_be_moved_are_read_where_they_are(tmp_path):
    former = tmp_path / "old" / "settings.json"
    SettingsStore(former).change(Settings(theme="dark"))
    (tmp_path / "new").write_text("", encoding="utf-8")
    store = SettingsStore(tmp_path / "new" / "settings.json", former)
    store.load()
    assert (store.settings.theme, store.problem) == ("dark", "")
    assert former.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="the folder of the system is another one")
def test_settings_stand_in_the_folder_of_the_system(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert default_path() == former_path() == tmp_path / "mtr-operator" / "settings.json"
    monkeypatch.delenv("XDG_CONFIG_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert default_path() == former_path() == tmp_path / ".config" / "mtr-operator" / "settings.json"


def test_settings_that_cannot_be_written_are_told(tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    store = SettingsStore(tmp_path / "file" / "settings.json")
    store.change(Settings(theme="dark"))
    assert store.settings.theme == "dark"
    assert "cannot be kept" in store.problem


def test_default_folders_are_the_operators_own():
    assert Settings().result_folder.is_relative_to(pathlib.Path.home())
