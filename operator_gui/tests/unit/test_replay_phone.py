"""A Digital key test whose phone is a signal of the Car's bus, computed anew from the log of that bus."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import shutil

import pytest
from replayed import recorded, replayed

from mtr_operator.cli import main
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.session_record import PHONE_FEED
from mtr_operator.domain.scenarios.digital_key import SCENARIO
from mtr_operator.domain.scenarios.digital_key.parameters import DigitalKeyParameters

DATABASE = """VERSION ""
BU_: GW
BO_ 288 LOCKS: 1 GW
 SG_ STATE : 0|1@1+ (1,0) [0|1] "" GW
BO_ 292 RANGING: 3 GW
 SG_ UWB : 0|16@1+ (1,-100) [-100|60000] "cm" GW
 SG_ OTHER : 16|8@1+ (1,0) [0|255] "cm" GW
"""
PROFILE = """database: car.dbc
message: LOCKS
signal: STATE
states: {0: locked, 1: unlocked}
cycle_time_s: 0.2
"""
PHONE = "phone_distance: {message: RANGING, signal: UWB}\n"
PARAMETERS = DigitalKeyParameters.from_mapping({
    **DigitalKeyParameters.proposed(), "minimum_distance_m": 1.0, "maximum_distance_m": 3.0, "spacing_m": 2.0,
    "angle_between_radials_deg": 90.0, "reading_time_s": 2.0, "stand_time_s": 0.2, "self_check": False})
PLACES = 8


def written(folder, phone):
    """Path of a profile, with its database."""
    (folder / "car.dbc").write_text(DATABASE)
    path = folder / f"car{len(list(folder.glob('*.yaml')))}.yaml"
    path.write_text(PROFILE + phone)
    return str(path)


@pytest.fixture(name="test", scope="module")
def test_fixture(tmp_path_factory):
    """Folder and results of a recorded test."""
    folder = tmp_path_factory.mktemp("phone")
    profile = written(folder, PHONE)
    progress = recorded(folder, SCENARIO, PARAMETERS, profile)
    return folder, progress.results


def now_of(document):
    """What the lines are now."""
    return [line["distances"][0]["now"] for line in document["lines"]]


def test_phone_on_the_bus_is_as_in_the_record(test, capsys):
    folder, results = test
    assert len(results) == PLACES and all(each.status is LineStatus.OK for each in results)
    code, document = replayed(folder, capsys)
    assert code == 0 and document["is_unchanged"] and document["measurements"] == PLACES
    assert [each["distance_m"] for each in now_of(document)] == [each.reported_m for each in results]
    assert document["worst_m"] == 0.0


def test_mended_unit_changes_every_distance(test, capsys, tmp_path):
    folder, results = test
    mended = written(tmp_path, PHONE.replace("UWB}", "UWB, unit: dm}"))
    code, document = replayed(folder, capsys, "--car-profile", mended)
    assert code == 3
    for each, result in zip(now_of(document), results):
        if each["status"] == "ok":
            assert each["distance_m"] == pytest.approx(10.0 * result.reported_m)
    assert any(each["status"] == "ok" for each in now_of(document))


def test_signal_that_is_always_the_same_makes_the_places_invalid(test, capsys, tmp_path):
    folder, _ = test
    other = written(tmp_path, PHONE.replace("UWB", "OTHER"))
    code, document = replayed(folder, capsys, "--car-profile", other)
    assert code == 3
    assert {each["status"] for each in now_of(document)} == {"invalid"}


def test_wrong_profile_is_mended_after_the_fact(test, capsys, tmp_path):
    """The record of a test with the wrong signal, and the log in which the right one is."""
    folder, results = test
    shutil.copytree(folder, tmp_path / "wrong")
    path = tmp_path / "wrong" / "progress.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    for line in record["results"]:
        line.update(status="invalid", answer="constant", error_m=None, error_low_m=None, error_high_m=None,
                    reason="The feed is frozen.")
    path.write_text(json.dumps(record), encoding="utf-8")
    code, document = replayed(tmp_path / "wrong", capsys)
    assert code == 3
    assert [each["distance_m"] for each in now_of(document)] == [each.reported_m for each in results]


def test_phone_that_came_another_way_is_one_sentence(test, capsys, tmp_path):
    folder, _ = test
    shutil.copytree(folder, tmp_path / "tcp")
    path = tmp_path / "tcp" / "progress.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    record["session"][PHONE_FEED] = "TCP 127.0.0.1:7070"
    path.write_text(json.dumps(record), encoding="utf-8")
    assert main(["replay", str(tmp_path / "tcp")]) == 2
    assert capsys.readouterr().err.strip() == (
        "The phone's distances came from TCP 127.0.0.1:7070, not over the Car's bus: its log does not hold them, and "
        "none can be computed anew.")


def test_profile_without_a_phone_is_named(test, capsys, tmp_path):
    folder, _ = test
    assert main(["replay", str(folder), "--car-profile", written(tmp_path, "")]) == 2
    assert "names no signal with the phone's distance (phone_distance)" in capsys.readouterr().err


def test_simulated_car_without_a_bus_is_named(tmp_path, capsys):
    demo = pathlib.Path(__file__).resolve().parents[2] / "examples" / "demo" / "relay_resistance.yaml"
    out = tmp_path / "out"
    assert main(["run", "relay_resistance", "--params", str(demo), "--out", str(out), "--simulated-robot",
                 "--simulated-car"]) == 0
    capsys.readouterr()
    assert main(["replay", str(out)]) == 2
    assert "was the simulated one, which has no bus" in capsys.readouterr().err
