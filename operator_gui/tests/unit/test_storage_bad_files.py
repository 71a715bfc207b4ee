"""Any file from outside is refused with a sentence or taken whole, within a second (C3, C5, C6, N2, N5)."""
# SPDX-License-Identifier: Apache-2.0
import gc
import json
import pathlib
import time

import pytest

from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, ProgressFileError
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.station.settings import Settings
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.station.test import open_test
from mtr_operator.storage.parameter_file import load_parameters
from mtr_operator.storage.progress_file import load_progress

WRITTEN_BEFORE = pathlib.Path(__file__).parent / "written_before"
LIMIT_S = 1.0
HUGE = 10 ** 400
INF = "1e999"


def spoilt(name, *keys, value):
    """Text of a good file in which the value at these keys is another one; INF as JSON writes it."""
    document = json.loads((WRITTEN_BEFORE / name / "progress.json").read_text(encoding="utf-8"))
    inner = document
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = value
    return json.dumps(document).replace(f'"{INF}"', INF)


BAD_AUTOLOCK = [
    # C3: infinite
    ("car", "length", INF), ("car", "length_sigma", INF), ("results", 0, "unlock_distance_m", INF),
    ("results", 0, "unlock_uncertainty_m", INF), ("results", 0, "origin_x_m", INF), ("session", "started", INF),
    ("retried", [INF]), ("retried", [1e999]), ("results", 0, "axis", INF),
    ("frame_record", "checks", 0, "limit_m", INF),
    # C3: beyond a float, of another kind, without unit
    ("car", "length", HUGE), ("car", "width", "NaN"), ("car", "width", "1.8"), ("car", "width", True),
    ("results", 0, "direction_x", None), ("results", 0, "direction_x", 5e7), ("results", 0, "side", None),
    ("results", 0, "side", 3), ("results", 0, "axis", HUGE), ("results", 0, "axis", 0), ("results", 0, "axis", 1.0),
    # C5, N2: a Car that is none
    ("car", "length", 4.5e6), ("car", "length", -4.5), ("car", "length", 0), ("car", "width", 1e9),
    ("car", "length_sigma", -0.1), ("car", "outline", [[1e9, 0.0]]), ("car", "outline", [[0.0, 0.0]] * 5000),
    ("car", "outline", [[0.0]]), ("car", "outline", 5),
    # N3: results that are none
    ("results", 0, "unlock_distance_m", 1e30), ("results", 0, "unlock_uncertainty_m", -0.03),
    ("results", 0, "unlock_uncertainty_m", 50.0), ("results", 0, "unlock_distance_m", None),
    ("results", 0, "reason", "A reason for a good line."), ("results", 0, "unlock_status", "not_reached"),
    ("results", 0, "unlock_robot_time_s", -1.0), ("results", 0, "axis", 4000),
    # N5
    ("car", [1]), ("car", 5), ("scenario", []), ("scenario", {}), ("scenario", None), ("version", [1]), ("format", {}),
    ("results", [[]]), ("results", [[1]]), ("results", "abc"), ("retried", {}), ("retried", ["1"]), ("retried", [99]),
    ("session", {"started": [1]}), ("frame_record", "checks", 0, "limit_m", "far"), ("frame_record", "checks", [1]),
    ("frame_record", "lines", {"x": 0}), ("frame_record", "lines", {"1": 0.0}), ("frame_record", "frames", [None]),
    ("frame_record", "checks", 0, "frame", 7), ("frame_record", []), ("parameters", []),
    ("parameters", "maximum_distance_m", HUGE), ("parameters", "maximum_distance_m", INF),
    ("parameters", "measurements_distance_m", "0.5"), ("journal", 5), ("journal", {"id": 1, "entries": "x"}),
]


def within_limit(action, *arguments):
    # A collection of what the whole session of tests has left would be counted, too.
    gc.disable()
    began_s = time.process_time()
    try:
        return action(*arguments)
    finally:
        gc.enable()
        assert time.process_time() - began_s < LIMIT_S


@pytest.mark.parametrize("case", BAD_AUTOLOCK, ids=lambda case: ".".join(map(str, case))[:60])
def test_spoilt_progress_file_is_a_sentence_for_window_and_command_line(tmp_path, case):  # C3, C5, N2, N3, N5
    path = tmp_path / "progress.json"
    path.write_text(spoilt("autolock", *case[:-1], value=case[-1]), encoding="utf-8")
    parameters = AutolockParameters.from_mapping(
        json.loads((WRITTEN_BEFORE / "autolock" / "progress.json").read_text(encoding="utf-8"))["parameters"])
    for load in (lambda: open_test(path), lambda: load_progress(path, SCENARIOS["autolock"], parameters.to_mapping())):
        with pytest.raises(ProgressFileError) as caught:
            within_limit(load)
        assert str(path) in str(caught.value) and len(str(caught.value)) < 500


def test_number_without_a_radial_is_a_sentence(tmp_path):
    path = tmp_path / "progress.json"
    path.write_text(spoilt("key_press", "results", -1, "radial", value=500), encoding="utf-8")
    with pytest.raises(ProgressFileError, match="holds radial 500"):
        open_test(path)


def test_parameters_that_do_not_suit_the_car_are_a_sentence(tmp_path):  # N5: Flow.open
    path = tmp_path / "progress.json"
    path.write_text(spoilt("key_press", "car", "length", value=29.0), encoding="utf-8")
    with pytest.raises(ProgressFileError, match="do not fit together"):
        open_test(path)


BOMB = "a: &a [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{new}: &{new} [{', '.join(['*' + old] * 10)}]\n" for old, new in zip("abcdefgh", "bcdefghi"))
BAD_YAML = ["maximum_distance_m: 2020-13-45\n", "maximum_distance_m: !!int x\n", f"maximum_distance_m: {'9' * 5000}\n",
            "[" * 5000, BOMB, "a: &a 1\nb: *a\n", "\x00", "{" * 30000, "maximum_distance_m: 2020-01-02\n",
            "maximum_distance_m: 2020-01-02 03:04:05\n", "maximum_distance_m: !!binary x\n", "? {a: 1}\n: 2\n",
            "!!timestamp x: 3\n", "".join(f"k{number}: 1\n" for number in range(9000)), f"{'k' * 60000}: 1\n",
            f"maximum_distance_m: '{'1,' + '0' * 60000}'\n", "maximum_distance_m: 0x" + "f" * 5000, "x" * 100_000,
            "maximum_distance_m: !!set {a, b}\n", "<<: 3\n", "maximum_distance_m: 1:60:60\n", "a: !!float x\n",
            "a: !!bool x\n", "a: !!null x\n", "!!omap x\n", "!!pairs [1]\n", "%YAML 9.9\n---\na: 1\n"]


@pytest.mark.parametrize("text", BAD_YAML, ids=lambda text: text[:30])
def test_bad_yaml_is_a_sentence(tmp_path, text):  # C6
    path = tmp_path / "bad.yaml"
    path.write_text(text, encoding="utf-8")
    for load, error in ((lambda: load_parameters(path, AutolockParameters), InvalidParameter),
                        (lambda: load_profile(str(path)), ConnectionFailed)):
        with pytest.raises(error) as caught:
            within_limit(load)
        assert len(str(caught.value)) < 1000


@pytest.mark.parametrize("content", [b"", b"VERSION", b"\xff\xfe\x00", b"BO_ 1 M: 8 X\n SG_ s : 0|9@1+\n",
                                     b"<?xml version='1.0'?><NetworkDefinition/>", b"[" * 9999, b"\x00" * 99])
def test_bad_database_is_a_sentence(tmp_path, content):  # C6
    text = (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text(encoding="utf-8")
    (tmp_path / "car.yaml").write_text(text, encoding="utf-8")
    for suffix in (".dbc", ".kcd", ".sym", ".cdd", ".arxml"):
        (tmp_path / "car.yaml").write_text(text.replace("mtr_demo_car.dbc", f"d{suffix}"), encoding="utf-8")
        (tmp_path / f"d{suffix}").write_bytes(content)
        with pytest.raises(ConnectionFailed):
            load_profile(str(tmp_path / "car.yaml"))


@pytest.mark.parametrize(("key", "value"), [
    ("connection", []), ("connection", {"robot": {"host": 5}, "can": None}), ("connection", {"robot": [], "can": None}),
    ("connection", {"robot": {"subscriber_port": INF}, "can": None}), ("hosts", 5), ("theme", []),
    ("connection", {"robot": {}, "can": {"interface": None}}), ("result_folder", 5), ("progress_folder", "a\0b"),
    ("unfinished", []), ("unfinished", "a\0b"), ("parameters", [1]), ("parameters", {"autolock": [1]}),
    ("parameters", {"autolock": {"maximum_distance_m": INF}}), ("parameters", {"autolock": {"key_height_m": []}}),
    ("parameters", {"autolock": {"key_height_m": HUGE}})])
def test_spoilt_settings_leave_the_defaults_with_a_sentence(tmp_path, key, value):
    path = tmp_path / "settings.json"
    SettingsStore(path).change(Settings(theme="dark"))
    document = {**json.loads(path.read_text(encoding="utf-8")), key: value}
    path.write_text(json.dumps(document).replace(f'"{INF}"', INF), encoding="utf-8")
    store = SettingsStore(path)
    store.load()
    assert store.settings == Settings() and "were not used" in store.problem
