"""A bundle of a test that is still written is refused, or holds what its manifest says; its link follows only then."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import shutil
import subprocess
import sys
import zipfile

import pytest

from mtr_operator.car_link.profile import PROFILE_FOLDER
from mtr_operator.cli import main
from mtr_operator.domain.errors import InUse, OutputError
from mtr_operator.domain.results.journal import EVENT
from mtr_operator.domain.results.session_record import now, session_record
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence.bundle import BundleWatch, write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.evidence.verification import verify_bundle
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.lock import Lock
from mtr_operator.storage.progress_file import open_progress
from mtr_operator.storage.recorded.folders import car_folder
from mtr_operator.storage.recorded.kept_car import digest_text, keep_car, profile_content
from mtr_operator.storage.store import Store

HOLDER = """
import pathlib, sys
from mtr_operator.storage.lock import Lock
with Lock(pathlib.Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture(name="measured", scope="module")
def measured_fixture(tmp_path_factory):
    """Folder of a test that was measured."""
    folder = tmp_path_factory.mktemp("measured") / "my_test"
    assert main(["demo", "--out", str(folder)]) == 0
    return folder


@pytest.fixture(name="test")
def test_fixture(measured, tmp_path):
    """Its progress file in a folder of this test's own, and the test as it was opened."""
    path = shutil.copytree(measured, tmp_path / "test") / "progress.json"
    scenario, _, progress = open_progress(path, SCENARIOS)
    return path, scenario, progress


@pytest.fixture(name="station")
def station_fixture(tmp_path):
    return Station(tmp_path / "station")


@pytest.fixture(name="bundled")
def bundled_fixture(test, station, tmp_path, monkeypatch):
    """Writes the bundle; its path. It has no report: that takes its time."""
    monkeypatch.setattr("mtr_operator.evidence.contents.report_files", lambda *_: {})

    def write(watch=None):
        path, scenario, progress = test
        target = tmp_path / "a.mtr.zip"
        write_bundle(target, path, scenario, progress, None, profile="mtr_demo_car", station=station, watch=watch)
        return target
    return write


def assert_nothing_is_left(station, tmp_path):
    assert station.newest is None
    assert not list(tmp_path.glob("*.zip")) and not list(tmp_path.glob(".*.part"))


def test_test_that_another_process_measures_is_not_bundled(test, bundled, station, tmp_path):
    with subprocess.Popen([sys.executable, "-c", HOLDER, str(test[0])], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}) as holder:
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(InUse, match=f"process {holder.pid}.* is measuring the test"):
            bundled()
        holder.stdin.close()
    assert_nothing_is_left(station, tmp_path)
    assert verify_bundle(bundled()).is_intact and station.newest.number == 1


def test_test_that_this_application_measures_is_not_bundled_either(test, bundled, station, tmp_path):
    with Store(test[0], test[2]), pytest.raises(InUse):
        bundled()
    assert_nothing_is_left(station, tmp_path)


def test_test_that_was_continued_since_it_was_opened_is_not_bundled(test, bundled, station, tmp_path):
    path, scenario, _ = test
    with Store(path, open_progress(path, SCENARIOS)[2]) as store:
        store.add(EVENT, {})
        store.save()
    with pytest.raises(InUse, match="was gone on with since it was opened"):
        bundled()
    assert_nothing_is_left(station, tmp_path)
    assert scenario


@pytest.mark.parametrize("name", ["recording/course_001.jsonl", "recording/events_001.csv", "progress.json",
                                  "progress.journal"])
@pytest.mark.parametrize("change", ["grows", "shrinks", "other bytes"])
def test_files_that_change_while_they_are_bundled_leave_an_intact_bundle(test, bundled, name, change):
    file = test[0].parent / name

    class Meanwhile(BundleWatch):
        """Somebody who keeps to no lock."""

        def done(self, share):
            content = file.read_bytes()
            file.write_bytes({"grows": content + b"more\n", "shrinks": content[:len(content) // 2],
                              "other bytes": bytes(reversed(content))}[change])
    assert verify_bundle(bundled(Meanwhile())).is_intact


def test_nobody_measures_the_test_while_it_is_bundled(test, bundled):
    refused = []

    class Meanwhile(BundleWatch):
        """Tries to go on with the test."""

        def done(self, share):
            with pytest.raises(InUse) as caught, Lock(test[0]):
                pass
            refused.append(caught)
    bundled(Meanwhile())
    assert refused
    with Lock(test[0]):
        pass


def test_full_disk_leaves_no_bundle_and_no_link(bundled, station, tmp_path, monkeypatch):
    def full(_):
        raise OSError(28, "No space left on device")
    monkeypatch.setattr("mtr_operator.evidence.bundle.os.fsync", full)
    with pytest.raises(OutputError, match="No space left"):
        bundled()
    assert_nothing_is_left(station, tmp_path)


@pytest.mark.parametrize("place", [0.2, 0.5, 0.9])
def test_bundle_that_does_not_read_back_as_it_was_signed_gets_no_link(bundled, station, tmp_path, monkeypatch, place):
    synchronise = os.fsync

    def spoil(descriptor):
        synchronise(descriptor)
        part, = tmp_path.glob(".*.part")
        content = bytearray(part.read_bytes())
        content[int(place * len(content))] ^= 1
        part.write_bytes(bytes(content))
    monkeypatch.setattr("mtr_operator.evidence.bundle.os.fsync", spoil)
    with pytest.raises(OutputError, match="a.mtr.zip was not written as it was signed: .* is changed"):
        bundled()
    assert_nothing_is_left(station, tmp_path)


@pytest.mark.parametrize("is_held", [False, True])
def test_test_in_an_archive_that_cannot_be_locked_is_bundled_unless_its_lock_is_there(test, bundled, is_held,
                                                                                      monkeypatch):
    take, lock = Lock._take, test[0].with_name(".progress.lock")
    if is_held:
        lock.write_text("1234")

    def read_only(self):
        if self._path == lock:
            raise OSError(30, "Read-only file system")
        return take(self)
    monkeypatch.setattr(Lock, "_take", read_only)
    if is_held:
        with pytest.raises(InUse, match="process 1234"):
            bundled()
    else:
        assert verify_bundle(bundled()).is_intact


def test_lock_of_a_killed_application_does_not_hinder(test, bundled):
    test[0].with_name(".progress.lock").write_text("1234")
    assert journal_path(test[0]).is_file() and verify_bundle(bundled()).is_intact


def test_bundle_holds_the_profile_with_which_the_test_was_measured(test, station, tmp_path, monkeypatch):
    monkeypatch.setattr("mtr_operator.evidence.contents.report_files", lambda *_: {})
    path, scenario, progress = test
    profile = tmp_path / "golf.yaml"
    content = (PROFILE_FOLDER / "mtr_demo_car.yaml").read_bytes()
    profile.write_bytes(content)
    shutil.copy(PROFILE_FOLDER / "mtr_demo_car.dbc", tmp_path)
    digests = digest_text(profile_content(str(profile)))
    progress.session.update(session_record(now(), "substitute", str(profile), digests))

    def bundled_profile(name):
        target = tmp_path / f"{name}.mtr.zip"
        write_bundle(target, path, scenario, progress, None, profile=str(profile), station=station)
        with zipfile.ZipFile(target) as container:
            left_out = json.loads(container.read("left_out.json")) if "left_out.json" in container.namelist() else {}
            held = "car/golf.yaml" in container.namelist()
            return container.read("car/golf.yaml") if held else left_out["car/golf.yaml"]
    assert bundled_profile("a") == content
    for kept in keep_car(path, str(profile)):
        assert kept.is_file()
    profile.write_bytes(content + b"\n")
    assert bundled_profile("b") == content
    shutil.rmtree(car_folder(path))
    assert bundled_profile("c") == f"The file {profile} has changed since the test was begun."
