"""Names of files in documents of others lead into the folder that is meant, or are refused."""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import json
import os
import pathlib
import zipfile

import measured
import pytest

from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import ConnectionFailed, OperatorError, OutputError, ProgressFileError, UnsafeName
from mtr_operator.domain.identity.file_name import MAX_BYTES, MAX_MADE_BYTES, name_problem, to_file_name
from mtr_operator.domain.identity.identity import Identity, Photo
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence import bundle
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.container import unpack
from mtr_operator.evidence.manifest import FileEntry
from mtr_operator.evidence.station_key import Station
from mtr_operator.evidence.verification import verify_bundle
from mtr_operator.storage.atomic import write_bytes
from mtr_operator.storage.calibration_file import record_path
from mtr_operator.storage.inside import below, inside
from mtr_operator.storage.journal.journal_file import JournalFile
from mtr_operator.storage.lock import Lock
from mtr_operator.storage.photos import copy_photos, keep_photos
from mtr_operator.storage.progress_file import open_progress

SECRET = b"-----BEGIN OPENSSH PRIVATE KEY-----\n"
BAD_NAMES = [
    "", ".", "..", "../x.jpg", "a/b.jpg", "/abs.jpg", "C:x.jpg", "C:\\x.jpg", "a\\b.jpg", "\\\\host\\share\\x.jpg",
    "x.jpg:stream", ".hidden.jpg", "x.jpg.", "x.jpg ", " x.jpg", "CON", "con.jpg", "nul .jpg", "COM1.jpg", "lpt9",
    "COM\u00b9.jpg", "CONIN$", "a\0b.jpg", "a\nb.jpg", "a\x1bb.jpg", "a\u202egpj.exe", "a\u200fb.jpg", "a\u2066b.jpg",
    "a\u200bb.jpg", "a\ufeffb.jpg", "a\ud800b.jpg", 300 * "a", 100 * "\u0159" + ".jpg", 10 ** 6 * "x", None, 7,
    ["x.jpg"]]
GOOD_NAMES = ["x.jpg", "Car (2).JPG", "Auto \u0159\u00edjen.jpg", "console.jpg", "com.jpg", "x..y.jpg", "$a$.jpg",
              "<b>.jpg", "=1.jpg", "nullable.png", MAX_BYTES * "a"]


@pytest.mark.parametrize("name", BAD_NAMES, ids=lambda name: ascii(name)[:30])
def test_name_that_is_no_plain_file_name_is_refused_with_a_sentence(tmp_path, name):
    assert name_problem(name)
    with pytest.raises(UnsafeName) as refusal:
        inside(tmp_path, name)
    sentence = str(refusal.value)
    assert sentence.startswith("The file name ") and sentence.isprintable() and len(sentence) < 300


@pytest.mark.parametrize("name", GOOD_NAMES, ids=lambda name: ascii(name)[:30])
def test_plain_name_leads_into_the_folder(tmp_path, name):
    assert inside(tmp_path, name) == tmp_path / name


@pytest.mark.parametrize("text", [*(name for name in BAD_NAMES if isinstance(name, str)), *GOOD_NAMES, "___", "..."],
                         ids=lambda name: ascii(name)[:30])
def test_any_text_becomes_a_plain_name(text):
    name = to_file_name(text, "usual")
    assert not name_problem(name)
    assert (name == text) is (not name_problem(text) and len(text) < MAX_MADE_BYTES)


def test_link_that_leads_out_is_refused_and_one_that_stays_is_not(tmp_path):
    folder = tmp_path / "test"
    folder.mkdir()
    (tmp_path / "secret").write_bytes(SECRET)
    (folder / "there.jpg").write_bytes(b"picture")
    for name, target in (("out.jpg", tmp_path / "secret"), ("up", tmp_path), ("in.jpg", "there.jpg"),
                         ("circle", "circle"), ("gone", tmp_path / "gone")):
        (folder / name).symlink_to(target)
    for name in ("out.jpg", "up", "circle", "gone"):
        with pytest.raises(UnsafeName, match="link that leads out|refused"):
            inside(folder, name)
    assert inside(folder, "in.jpg").read_bytes() == b"picture"
    with pytest.raises(UnsafeName):
        below(folder, "up/secret")
    assert below(tmp_path, "test/there.jpg") == folder / "there.jpg"


def test_relative_folder_is_a_folder_too(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert below(inside(tmp_path, "a"), "b").resolve() == (tmp_path / "a" / "b").resolve()
    assert inside(pathlib.Path("out"), "plan") == pathlib.Path("out/plan")


def received(folder, name, content=b"evil", digest=None):
    """A received test whose record names a photo."""
    path = measured.in_folder(folder, 5.0)
    document = json.loads(path.read_text(encoding="utf-8"))
    document["identity"] = {"photos": [{"name": name, "sha256": digest or hashlib.sha256(content).hexdigest()}]}
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", ["../../.config/autostart/evil.desktop", "/etc/evil", "C:evil", "..", "a\u202eb.jpg"])
def test_record_that_names_a_photo_elsewhere_is_refused(tmp_path, name):
    with pytest.raises(ProgressFileError, match="under photos is refused"):
        open_progress(received(tmp_path / "test", name), SCENARIOS)


def test_photo_whose_content_is_not_the_recorded_one_is_neither_copied_nor_bundled(tmp_path, caplog):
    photo = Photo("car.jpg", hashlib.sha256(b"picture").hexdigest())
    path = measured.in_folder(tmp_path / "test", 5.0, identity=Identity("WVW1", photos=(photo,)))
    (path.parent / "photos").mkdir()
    (path.parent / "photos" / "car.jpg").write_bytes(b"another")
    copy_photos((photo,), path.parent / "photos", tmp_path / "copy")
    assert not (tmp_path / "copy" / "car.jpg").exists() and "was changed" in caplog.text
    assert "was changed" in bundled(path, tmp_path)[1]["photos/car.jpg"]
    (path.parent / "photos" / "car.jpg").write_bytes(b"picture")
    copy_photos((photo,), path.parent / "photos", tmp_path / "copy")
    assert (tmp_path / "copy" / "car.jpg").read_bytes() == b"picture"
    assert "photos/car.jpg" in bundled(path, tmp_path)[0]


def test_folder_of_photos_that_is_a_link_is_neither_read_nor_written(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "x.jpg").write_bytes(b"picture")
    (tmp_path / "test").mkdir()
    (tmp_path / "test" / "photos").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(UnsafeName, match="link that leads out"):
        keep_photos([tmp_path / "x.jpg"], tmp_path / "test" / "photos")
    assert not any((tmp_path / "elsewhere").iterdir())


@pytest.mark.parametrize("name", [".hidden.jpg", "12:30.jpg", "CON.jpg", "x .jpg", 240 * "a" + ".jpg"])
def test_photo_of_any_name_is_kept_under_a_plain_one(tmp_path, name):
    (tmp_path / name).write_bytes(b"picture")
    photo, = keep_photos([tmp_path / name], tmp_path / "photos")
    assert not name_problem(photo.name) and (tmp_path / "photos" / photo.name).read_bytes() == b"picture"
    path = measured.in_folder(tmp_path / "test", 5.0, identity=Identity(photos=(photo,)))
    assert open_progress(path, SCENARIOS)[2].identity.photos == (photo,)


def bundled(path, tmp_path, profile=""):
    """Names of the files in a bundle of a test with all their content, and what is left out."""
    scenario, _, progress = open_progress(path, SCENARIOS)
    target = tmp_path / "a.mtr.zip"
    write_bundle(target, path, scenario, progress, None, profile=profile, station=Station(tmp_path / "station"))
    with zipfile.ZipFile(target) as container:
        content = {name: container.read(name) for name in container.namelist()}
    assert not [name for name, each in content.items() if SECRET in each]
    left_out = json.loads(content.get("left_out.json", b"{}"))
    return set(content), left_out


PROFILE = ("database: {}\nmessage: LockStatus\nsignal: State\nstates: {{0: unlocked, 1: locked}}\n"
           "cycle_time_s: 0.1\n")


@pytest.mark.parametrize("name", ["../.ssh/id_ed25519", "{home}/.ssh/id_ed25519", "id_copy", "id_link.dbc",
                                  "sub/id_link.dbc", "..\\.ssh\\id_ed25519", "C:\\id_ed25519", "folder"])
def test_bundle_takes_no_file_that_is_no_can_database_beside_the_profile(tmp_path, monkeypatch, name):
    monkeypatch.delenv("MTR_CAR_DATABASES", raising=False)
    home, folder = tmp_path / "home", tmp_path / "home" / "cars"
    (home / ".ssh").mkdir(parents=True)
    (folder / "folder").mkdir(parents=True)
    for place in (home / ".ssh" / "id_ed25519", folder / "id_copy"):
        place.write_bytes(SECRET)
    (folder / "id_link.dbc").symlink_to(home / ".ssh" / "id_ed25519")
    (folder / "sub").symlink_to(home / ".ssh")
    profile = folder / "car.yaml"
    profile.write_text(PROFILE.format(json.dumps(name.format(home=home))), encoding="utf-8")
    names, left_out = bundled(measured.in_folder(tmp_path / "test", 5.0), tmp_path, str(profile))
    assert {each for each in names if each.startswith("car/")} == {"car/car.yaml"} and left_out["car/CAN database"]
    with pytest.raises(ConnectionFailed):
        load_profile(str(profile))


def test_database_of_the_configured_folder_is_bundled(tmp_path, monkeypatch):
    (tmp_path / "databases").mkdir()
    (tmp_path / "databases" / "own.dbc").write_bytes((PROFILE_FOLDER / "mtr_demo_car.dbc").read_bytes())
    text = (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text(encoding="utf-8").replace("mtr_demo_car.dbc", "own.dbc")
    (tmp_path / "car.yaml").write_text(text, encoding="utf-8")
    monkeypatch.setenv("MTR_CAR_DATABASES", str(tmp_path / "databases"))
    names, _ = bundled(measured.in_folder(tmp_path / "test", 5.0), tmp_path, str(tmp_path / "car.yaml"))
    assert {"car/car.yaml", "car/own.dbc"} <= names


@pytest.mark.parametrize("profile", ["../../.ssh/id_ed25519", "/etc/passwd", "", "x\0y", 5000 * "x", "<b>", "\u202e"])
def test_record_names_a_profile_that_is_none_and_the_bundle_is_written_without(tmp_path, profile):
    names, left_out = bundled(measured.in_folder(tmp_path / "test", 5.0), tmp_path, profile)
    assert not [each for each in names if each.startswith("car/")] and "record.json" in names
    assert bool(left_out) is bool(profile)


@pytest.mark.parametrize("planted", ["recording", "photos", "recording/course_001.jsonl", "photos/x.jpg",
                                     "progress.journal"])
def test_links_in_a_received_folder_are_not_followed_into_a_bundle(tmp_path, planted):
    (tmp_path / "secrets").mkdir()
    (tmp_path / "secrets" / "id_ed25519").write_bytes(SECRET)
    path = measured.in_folder(tmp_path / "test", 5.0)
    place = path.parent / planted
    place.parent.mkdir(exist_ok=True)
    place.symlink_to(tmp_path / "secrets" / ("" if planted in ("recording", "photos") else "id_ed25519"))
    _, left_out = bundled(path, tmp_path)
    assert [reason for name, reason in left_out.items() if "link" in reason], left_out


@pytest.mark.parametrize("name", ["../evil", "/tmp/evil", "a/../../evil", "C:evil", "a\\evil", "CON", "a//b", "a/",
                                  "x\u202ey"])
def test_container_with_a_name_that_leads_out_is_not_unpacked(tmp_path, name):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as container:
        container.writestr("good", b"good")
        container.writestr(name, b"evil")
    (tmp_path / "target").mkdir()
    with zipfile.ZipFile(tmp_path / "a.zip") as container, pytest.raises(OperatorError):
        unpack(container, tmp_path / "target")
    assert not any((tmp_path / "target").iterdir())


def test_signed_bundle_with_a_name_that_leads_out_is_not_intact(tmp_path, monkeypatch):
    path = measured.in_folder(tmp_path / "test", 5.0)
    scenario, _, progress = open_progress(path, SCENARIOS)
    written = bundle.contents_of

    def hostile(*arguments):
        found = written(*arguments)
        found.sources["../evil"] = b"evil"
        return found
    monkeypatch.setattr(bundle, "contents_of", hostile)
    target = tmp_path / "a.mtr.zip"
    with pytest.raises(OutputError, match="'../evil' is refused"):
        write_bundle(target, path, scenario, progress, None, station=Station(tmp_path / "station"))
    # Another program signs what it likes.
    monkeypatch.setattr(bundle, "content_problems", lambda *_: [])
    manifest = write_bundle(target, path, scenario, progress, None, station=Station(tmp_path / "station"))
    assert isinstance(manifest.files["../evil"], FileEntry)
    assert any("'../evil' is refused" in problem for problem in verify_bundle(target).problems)


@pytest.mark.parametrize("name", [".progress.json.part", ".progress.lock", "progress.journal"])
def test_link_that_lies_in_wait_under_the_name_of_a_file_is_not_written_through(tmp_path, name):
    (tmp_path / "bashrc").write_bytes(b"mine")
    (tmp_path / "test").mkdir()
    (tmp_path / "test" / name).symlink_to(tmp_path / "bashrc")
    path = tmp_path / "test" / "progress.json"
    if name.endswith(".part"):
        write_bytes(path, b"new")
        assert path.read_bytes() == b"new"
    else:
        with pytest.raises(OutputError):
            Lock(path).__enter__() if name.endswith(".lock") else JournalFile(tmp_path / "test" / name).open(0)
    assert (tmp_path / "bashrc").read_bytes() == b"mine"


@pytest.mark.parametrize("robot", ["../../x", "/abs", "C:x", "CON", "..", "a\0b", 1000 * "r", "", "10.0.0.1"])
def test_calibration_record_of_any_robot_lies_in_its_folder(tmp_path, robot):
    path = record_path(tmp_path, robot)
    assert path.parent == tmp_path and not name_problem(path.name) and os.path.basename(path).endswith(".yaml")


@pytest.mark.parametrize("name", ["/etc/passwd", "a//b", "a/", "/"])
def test_path_with_an_empty_part_is_quoted_whole(tmp_path, name):
    with pytest.raises(UnsafeName, match="'" + name + "' is refused. It contains a path separator"):
        below(tmp_path, name)
