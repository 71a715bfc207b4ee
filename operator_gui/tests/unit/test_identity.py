"""Whose car and key, who measured where with what: read, required, kept with the record, and in its files."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import datetime
import hashlib
import json
import pathlib

import pytest
import yaml

from mtr_operator.cli import main
from mtr_operator.domain.errors import InvalidIdentity, OutputError, ProgressFileError
from mtr_operator.domain.identity.equipment_text import equipment_from_text, equipment_text
from mtr_operator.domain.identity.identity import NOBODY, TITLES, Equipment, Identity, Photo
from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.domain.identity.laboratory import laboratory_from
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.identity_file import load_identity, load_laboratory
from mtr_operator.storage.photos import MAX_BYTES, check_photos, keep_photos, photo_folder
from mtr_operator.storage.progress_file import load_progress, open_progress, save_progress

DAY = datetime.date(2026, 3, 1)
FULL = Identity("WVWZZZ1KZAW000001", "Golf", "0412", "0042", "remote", 3.02, "J. Nov\u00e1k", "Hall 2", "dry",
                "Doors shut.\nOne other key.", (Equipment("multimeter", "77", DAY, datetime.date(2027, 3, 1)),
                                                Equipment("tape")), (Photo("car.jpg", "0" * 64),))


def test_identity_survives_its_document_as_json():
    assert identity_from(json.loads(json.dumps(FULL.to_document()))) == FULL
    assert NOBODY.to_document() == {} and identity_from({}).is_empty


@pytest.mark.parametrize("document, sentence", [
    ([], "it has to consist of lines of the form 'name: value'."),
    ({"car_vim": "x"}, "'car_vim' is unknown; did you mean 'car_vin'?"),
    ({"key_serial": 42}, "key_serial is a number; write it in quotes, so that its zeros are kept."),
    ({"operator": "a\nb"}, "operator has to be a text of at most 120 characters in one line."),
    ({"operator": 121 * "x"}, "operator has to be a text of at most 120 characters in one line."),
    ({"notes": 4001 * "x"}, "notes has to be a text of at most 4000 characters."),
    ({"key_battery_v": 75}, "key_battery_v is 75 V; allowed is 0 to 60 V."),
    ({"key_battery_v": float("nan")}, "key_battery_v is nan V; allowed is 0 to 60 V."),
    ({"equipment": {}}, "equipment has to be a list of at most 40 entries."),
    ({"equipment": [{}]}, "equipment 1: name is missing."),
    ({"equipment": [{"name": "tape", "calibrated": "soon"}]},
     "equipment 1: calibrated has to be a day such as 2026-03-01."),
    ({"equipment": [{"name": "tape", "calibrated": "2026-03-02", "valid_until": "2026-03-01"}]},
     "equipment 1: valid_until, 2026-03-01, is before calibrated, 2026-03-02."),
    ({"photos": [{"name": "x.jpg", "sha256": "0"}]}, "photos has to be a list of files with name and sha256.")])
def test_wrong_identity_is_refused_with_one_sentence(document, sentence):
    with pytest.raises(InvalidIdentity) as refusal:
        identity_from(document)
    assert str(refusal.value) == sentence


def test_next_test_has_neither_notes_nor_photos_and_on_another_day_no_weather_and_battery():
    same = FULL.of_another_test(is_same_day=True)
    assert (same.notes, same.photos) == ("", ()) and (same.weather, same.key_battery_v) == ("dry", 3.02)
    later = FULL.of_another_test(is_same_day=False)
    assert (later.weather, later.key_battery_v) == ("", None) and later.car_vin == FULL.car_vin


def test_equipment_is_typed_one_a_line():
    text = "multimeter; 77; 2026-03-01; 2027-03-01\n\n tape \n"
    assert equipment_from_text(text) == FULL.equipment
    assert equipment_from_text(equipment_text(FULL.equipment)) == FULL.equipment
    with pytest.raises(InvalidIdentity, match="equipment 2: it has 5 parts"):
        equipment_from_text("tape\na;b;2026-03-01;2027-03-01;c")


def test_calibration_that_has_run_out_is_warned_of_from_the_day_after():
    assert FULL.warnings(datetime.date(2027, 3, 1)) == []
    assert FULL.warnings(datetime.date(2027, 3, 2)) == ["The calibration of multimeter was valid until 2027-03-01. "
                                                         "Calibrate it again, or take another one."]


def test_laboratory_names_what_is_missing_in_one_sentence():
    laboratory = laboratory_from({"required": ["car_vin", "equipment", "photos"], "defaults": {"place": "Hall 2"}})
    assert laboratory.missing(NOBODY) == ["car_vin", "equipment", "photos"]
    assert laboratory.missing(FULL) == ["equipment"], "tape has no day of calibration"
    calibrated = dataclasses.replace(FULL, equipment=FULL.equipment[:1], photos=())
    assert laboratory.missing(calibrated) == ["photos"] and laboratory.missing(calibrated, 1) == []
    with pytest.raises(InvalidIdentity) as refusal:
        laboratory.check(NOBODY, 0)
    assert str(refusal.value) == ("The test does not start: the laboratory requires Car's VIN (car_vin), Equipment "
                                  "(equipment), Photos (photos) with the day of its calibration.")


@pytest.mark.parametrize("text, sentence", [
    ("required: [car]", "required: 'car' is unknown"), ("required: car_vin", "required has to be a list of keys"),
    ("defaults: {place: 1}", "place is a number"), ("[", "is not valid YAML"),
    ("require: []", "did you mean 'required'")])
def test_damaged_laboratory_file_is_refused_and_does_not_mean_that_nothing_is_required(tmp_path, text, sentence):
    path = tmp_path / "laboratory.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidIdentity, match="laboratory.yaml") as refusal:
        load_laboratory(path)
    assert sentence in str(refusal.value)


def test_laboratory_without_a_file_or_with_an_empty_one_requires_nothing(tmp_path):
    assert load_laboratory(tmp_path / "none.yaml").required == ()
    (tmp_path / "empty.yaml").write_text("", encoding="utf-8")
    assert load_laboratory(tmp_path / "empty.yaml").required == ()


def test_photos_are_kept_under_free_names_with_check_sums(tmp_path):
    sources = []
    for number in (1, 2):
        source = tmp_path / str(number) / "Car.JPG"
        source.parent.mkdir()
        source.write_bytes(bytes([number]))
        sources.append(source)
    kept = keep_photos(sources, tmp_path / "photos")
    assert [photo.name for photo in kept] == ["Car.jpg", "Car_2.jpg"]
    for photo, source in zip(kept, sources):
        assert (tmp_path / "photos" / photo.name).read_bytes() == source.read_bytes()
        assert photo.sha256 == hashlib.sha256(source.read_bytes()).hexdigest()


def test_photo_that_is_none_is_refused_before_the_test(tmp_path):
    with pytest.raises(InvalidIdentity, match="gone.jpg cannot be read"):
        check_photos([tmp_path / "gone.jpg"])
    (tmp_path / "x.sh").write_text("", encoding="utf-8")
    with pytest.raises(InvalidIdentity, match="is no photo; kept are .jpg"):
        check_photos([tmp_path / "x.sh"])
    large = tmp_path / "large.png"
    with open(large, "wb") as file:
        file.truncate(MAX_BYTES + 1)
    with pytest.raises(InvalidIdentity, match="no file of at most 40 MiB"):
        check_photos([large])
    with pytest.raises(InvalidIdentity, match="at most 20"):
        check_photos(21 * [large])


def test_photos_that_cannot_be_copied_are_said(tmp_path):
    (tmp_path / "x.png").write_bytes(b"x")
    (tmp_path / "photos").write_bytes(b"a file in the way")
    with pytest.raises(OutputError, match="cannot be copied"):
        keep_photos([tmp_path / "x.png"], tmp_path / "photos")


def test_folder_of_photos_follows_the_record():
    assert photo_folder(pathlib.Path("out/progress.json")) == pathlib.Path("out/photos")
    assert photo_folder(pathlib.Path("autolock_1.json")) == pathlib.Path("autolock_1.photos")


def test_record_keeps_the_identity_and_one_from_before_has_none(tmp_path):
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type().to_mapping()
    path = tmp_path / "progress.json"
    save_progress(path, Progress(scenario.name, parameters, identity=FULL))
    assert load_progress(path, scenario, parameters).identity == FULL
    document = json.loads(path.read_text(encoding="utf-8"))
    del document["identity"]
    path.write_text(json.dumps(document), encoding="utf-8")
    assert load_progress(path, scenario, parameters).identity is None
    path.write_text(json.dumps({**document, "identity": {"car_vin": 5}}), encoding="utf-8")
    with pytest.raises(ProgressFileError, match="damaged"):
        load_progress(path, scenario, parameters)


@pytest.fixture
def run(tmp_path, monkeypatch, robot_link, car_link):
    """run(*options) measures four radials on the command line; the exit code."""
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    monkeypatch.setattr("mtr_operator.cli.identity.laboratory_path", lambda: tmp_path / "laboratory.yaml")
    (tmp_path / "parameters.yaml").write_text("angle_between_radials_deg: 90.0\n", encoding="utf-8")
    (tmp_path / "car.jpg").write_bytes(b"picture")
    (tmp_path / "identity.yaml").write_text(yaml.safe_dump(
        {**{name: value for name, value in FULL.to_document().items()}, "photos": ["car.jpg"]}), encoding="utf-8")
    return lambda *options: main(["run", "key_press", "--params", str(tmp_path / "parameters.yaml"),
                                  "--out", str(tmp_path / "out"), *map(str, options)])


def test_command_line_writes_the_identity_to_all_files(run, tmp_path):
    assert run("--identity", tmp_path / "identity.yaml") == 0
    out = tmp_path / "out"
    _, _, progress = open_progress(out / "progress.json", SCENARIOS)
    digest = hashlib.sha256(b"picture").hexdigest()
    assert progress.identity == dataclasses.replace(FULL, photos=(Photo("car.jpg", digest),))
    assert (out / "photos" / "car.jpg").read_bytes() == b"picture"
    head = [line for line in (out / "results.csv").read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    assert {"# identity car_vin: WVWZZZ1KZAW000001", "# identity key_battery_v: 3.02 V", f"# identity photo: car.jpg "
            f"(SHA-256 {digest})", "# identity notes: Doors shut. One other key.",
            "# identity equipment: multimeter; 77; 2026-03-01; 2027-03-01"} <= set(head)
    # Also where the journal alone is left.
    (out / "progress.json").unlink()
    assert open_progress(out / "progress.json", SCENARIOS)[2].identity == progress.identity


def test_test_without_what_the_laboratory_requires_does_not_start_and_leaves_nothing(run, tmp_path, capsys, world):
    (tmp_path / "laboratory.yaml").write_text("required: [operator, weather]\ndefaults: {operator: Shift A}\n",
                                              encoding="utf-8")
    assert run() == 2
    assert capsys.readouterr().err.strip() == ("The test does not start: the laboratory requires Weather (weather).")
    assert not (tmp_path / "out").exists() and world.desired is None
    assert run("--identity", tmp_path / "identity.yaml") == 0


def test_defaults_of_the_laboratory_are_in_the_record(run, tmp_path):
    (tmp_path / "other.yaml").write_text("defaults: {place: Hall 9}\n", encoding="utf-8")
    assert run("--laboratory", tmp_path / "other.yaml") == 0
    assert open_progress(tmp_path / "out" / "progress.json", SCENARIOS)[2].identity == Identity(place="Hall 9")


def test_test_is_continued_with_its_own_car_only_and_learns_what_was_not_said(run, tmp_path, capsys):
    assert run("--identity", tmp_path / "identity.yaml") == 0
    other = tmp_path / "other.yaml"
    other.write_text("car_vin: OTHER\n", encoding="utf-8")
    continued = ["--continue", tmp_path / "out" / "progress.json"]
    assert run(*continued, "--identity", other) == 2
    assert "another car_vin, WVWZZZ1KZAW000001; now it is OTHER" in capsys.readouterr().err
    other.write_text("weather: rain\n", encoding="utf-8")
    assert run(*continued, "--identity", other) == 0
    progress = open_progress(tmp_path / "out" / "progress.journal", SCENARIOS)[2]
    assert (progress.identity.weather, progress.identity.car_vin) == ("rain", FULL.car_vin)
    assert [photo.name for photo in progress.identity.photos] == ["car.jpg"]


def test_examples_are_complete_but_for_what_the_laboratory_adds():
    folder = pathlib.Path(__file__).parents[2] / "examples" / "identity"
    laboratory, given = load_laboratory(folder / "laboratory.yaml"), load_identity(folder / "my_test.yaml")
    assert laboratory.missing(given.identity) == ["equipment"]
    assert laboratory.missing(given.identity.filled_from(laboratory.defaults)) == []


def test_every_key_has_a_title_and_a_file_says_where_it_is_wrong(tmp_path):
    assert set(TITLES) == {field.name for field in dataclasses.fields(Identity)}
    path = tmp_path / "identity.yaml"
    path.write_text("photos: car.jpg\n", encoding="utf-8")
    with pytest.raises(InvalidIdentity) as refusal:
        load_identity(path)
    assert str(refusal.value) == f"In the file {path}: photos has to be a list of at most 20 paths."
