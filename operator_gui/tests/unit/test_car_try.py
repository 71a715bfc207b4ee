"""A profile is tried by a whole Autolock of a simulated Car that speaks its frames, whatever the profile's kind."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib

import pytest

from mtr_operator.car_link.profile import load_profile, profile_files
from mtr_operator.cli import main
from mtr_operator.cli.cars.trying import try_profile
from mtr_operator.domain.errors import ConnectionFailed

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples" / "cars"
# Folder of CAN databases of real cars, which are no part of the project; `make try-cars DBC=FOLDER` sets it.
DATABASES = os.environ.get("MTR_CAR_DATABASES", "")
BODY = """VERSION ""
BU_: GW
BO_ 2566848513 Doors: 64 GW
 SG_ Page M : 7|2@0+ (1,0) [0|3] "" GW
 SG_ Lock m2 : 20|2@0+ (1,0) [0|3] "" GW
 SG_ Alive : 300|4@1+ (1,0) [0|15] "" GW
BO_ 300 Lids: 8 GW
 SG_ DriverOpen : 3|1@0+ (1,0) [0|1] "" GW
"""
KEYS = """VERSION ""
BU_: GW
BO_ 500 Key: 8 GW
 SG_ Why : 7|4@0+ (1,0) [0|15] "" GW
 SG_ Events : 8|8@1+ (1,0) [0|255] "" GW
"""
PAGED_FD = """database: body.dbc
buses: {keys: keys.dbc}
message: Doors
signal: Lock
states: {2: locked, 1: unlocked, 3: unlocked_driver}
cycle_time_s: 0.2
alive_signal: Alive
command_signal: {bus: keys, message: Key, signal: Events}
causes: [{bus: keys, message: Key, signal: Why, sources: {4: passive_entry, 5: key_button}, stays: true}]
cause_required: true
doors: {driver: {message: Lids, signal: DriverOpen}}
"""
ASKED = """uds_poll:
  {request_id: 0x7A0, response_id: 0x7A8, data_identifier: 0xF190, byte: BYTE, mask: 0x0C, every_s: 0.2}
states: {1: locked, 2: unlocked}
"""


def written(folder, text):
    """Path of a profile with its databases."""
    (folder / "body.dbc").write_text(BODY)
    (folder / "keys.dbc").write_text(KEYS)
    path = folder / "car.yaml"
    path.write_text(text)
    return str(path)


def test_databases_in_a_folder_of_their_own_are_found_where_the_environment_names_it(tmp_path, monkeypatch):
    profile, folder = tmp_path / "car.yaml", tmp_path / "databases"
    folder.mkdir()
    written(folder, PAGED_FD)
    (folder / "car.yaml").rename(profile)
    monkeypatch.setenv("MTR_CAR_DATABASES", str(tmp_path / "elsewhere"))
    with pytest.raises(ConnectionFailed, match="body.dbc cannot be read"):
        load_profile(str(profile))
    monkeypatch.setenv("MTR_CAR_DATABASES", str(folder))
    assert load_profile(str(profile)).message.name == "Doors"
    assert profile_files(str(profile)) == (profile, folder / "body.dbc", folder / "keys.dbc")


@pytest.mark.parametrize("text", [PAGED_FD, ASKED.replace("BYTE", "1"), ASKED.replace("BYTE", "11")],
                         ids=["pages, FD, two buses", "asked", "asked, answers in several frames"])
def test_car_that_a_profile_describes_passes_an_autolock(tmp_path, text):
    tried = try_profile(written(tmp_path, text))
    assert tried.is_good, tried
    assert tried.sent >= 16 and len(tried.results) == 8
    causes = {result.unlock_cause for result in tried.results}
    assert causes == ({"passive_entry"} if text is PAGED_FD else {"unknown"})


def test_results_say_which_key_moved_the_locks_and_which_doors_it_unlocked(tmp_path, monkeypatch):
    text = PAGED_FD + "key_number: {bus: keys, message: Key, signal: Number, under_test: 2}\n"
    path = written(tmp_path, text)
    (tmp_path / "keys.dbc").write_text(KEYS + ' SG_ Number : 16|4@1+ (1,0) [0|15] "" GW\n')
    # The driver's door alone.
    monkeypatch.setattr("mtr_operator.car_link.further.spoken_frames.state_raw",
                        lambda profile, is_locked: 2 if is_locked else 3)
    tried = try_profile(path)
    assert tried.is_good, tried
    assert {(each.unlock_key_number, each.unlock_doors, each.lock_key_number, each.lock_doors)
            for each in tried.results} == {(2, "driver", 2, "")}


def test_command_says_what_was_understood(tmp_path, capsys):
    path = written(tmp_path, PAGED_FD)
    assert main(["try", path, str(tmp_path / "none.yaml")]) == 2
    said = capsys.readouterr()
    assert "changes understood" in said.out and "8 of 8 axes measured" in said.out
    assert "There is no car profile" in said.err


def test_profile_that_hears_another_signal_is_told(tmp_path, capsys, monkeypatch):
    path = written(tmp_path, PAGED_FD)
    # The Car's locks move, and its bus says that they do not.
    monkeypatch.setattr("mtr_operator.car_link.further.spoken_frames.state_raw", lambda *_: 2)
    assert main(["try", path]) == 3
    assert "0 of 18 changes understood" in capsys.readouterr().out


@pytest.mark.skipif(not DATABASES, reason="CAN databases of real cars are no part of the project; name their folder: "
                                          "make try-cars DBC=FOLDER")
@pytest.mark.parametrize("name", ["toyota_2017", "mazda_2017", "hyundai_2015"])
def test_real_car_passes_an_autolock(name):
    tried = try_profile(str(EXAMPLES / f"{name}.yaml"), pathlib.Path(DATABASES))
    assert tried.is_good, tried


@pytest.mark.parametrize("name", ["toyota_2017", "mazda_2017", "hyundai_2015"])
def test_profile_of_a_real_car_says_which_database_it_lacks(name, capsys, monkeypatch):
    monkeypatch.delenv("MTR_CAR_DATABASES", raising=False)
    assert main(["try", str(EXAMPLES / f"{name}.yaml")]) == 2
    assert f"{name.rpartition('_')[0]}_201" in capsys.readouterr().err


@pytest.mark.parametrize(("signal", "texts", "doubtful"), [
    ("Lock", '0 "Locked" 1 "Unlocked" 2 "Locked"', ""), ("Lock", '1 "Locked"', "1: unlocked"),
    ("Lock", '2 "all doors unlocked"', "2: locked"), ("Lock", '2 "Entriegelt" 3 "double_unlock"', "2: locked"),
    ("Lock", '2 "verriegelt"', ""), ("Lock", '2 "not locked" 1 "Blocked"', "2: locked"),
    ("Lock", '2 "lock/unlock" 1 "Clock"', ""), ("Lock", '7 "Unlocked"', ""), ("Page", '1 "Locked"', "")])
def test_state_that_the_database_describes_otherwise_is_printed(tmp_path, capsys, signal, texts, doubtful):
    profile = written(tmp_path, PAGED_FD)
    (tmp_path / "body.dbc").write_text(BODY + f"VAL_ 2566848513 {signal} {texts} ;\n")
    assert main(["try", profile]) == 0
    printed = capsys.readouterr().err
    assert printed.count("check on the Car") == bool(doubtful) and f"states has {doubtful}" in printed + "states has "
