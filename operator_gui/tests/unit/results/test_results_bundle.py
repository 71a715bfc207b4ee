"""Import of bundles: accepted with a valid signature of a trusted station, otherwise rejected with a sentence."""
# SPDX-License-Identifier: Apache-2.0
import zipfile

import measured
import pytest

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.container import write_container
from mtr_operator.evidence.manifest import MANIFEST, SIGNATURE
from mtr_operator.evidence.station_key import Station
from mtr_operator.storage.progress_file import open_progress
from mtr_results.intake.source import tests_in as paths_in
from mtr_results.store import reading


@pytest.fixture(name="station")
def station_fixture(tmp_path):
    """Return a station for this test only."""
    return Station(tmp_path / "station")


@pytest.fixture(name="bundle")
def bundle_fixture(tmp_path, station):
    """Return a signed bundle with one test."""
    path = measured.in_folder(tmp_path / "test", 5.0, 5.5, 6.0, 6.5)
    scenario, _, progress = open_progress(path, SCENARIOS)
    target = tmp_path / "bundles" / "one.mtr.zip"
    target.parent.mkdir()
    write_bundle(target, path, scenario, progress, None, station=station)
    return target


def count(place):
    with place.open().reading() as connection:
        return len(reading.find(connection, reading.Search()))


def taken(place, path, *stations):
    return [place.door(stations).take(found) for found in paths_in(path)]


def test_a_bundle_goes_in_as_its_folder_would(place, bundle, tmp_path, station):
    assert [each.outcome for each in taken(place, bundle.parent, station.key)] == ["added"]
    assert [each.outcome for each in taken(place, tmp_path / "test")] == ["known"]
    assert count(place) == 1


def test_a_changed_bundle_is_refused_with_what_is_changed_and_the_store_stays(place, bundle):
    content = bytearray(bundle.read_bytes())
    with zipfile.ZipFile(bundle) as container:
        info = container.getinfo("progress.json")
    content[info.header_offset + 30 + len(info.filename) + info.file_size // 2] ^= 1
    bundle.write_bytes(bytes(content))
    (intake,) = taken(place, bundle)
    assert intake.outcome == "refused" and "is not as it was signed. progress.json is changed." in intake.sentence
    assert count(place) == 0


def test_a_torn_bundle_is_refused(place, bundle):
    bundle.write_bytes(bundle.read_bytes()[:-200])
    (intake,) = taken(place, bundle)
    assert intake.outcome == "refused" and "is torn, or no bundle" in intake.sentence
    assert count(place) == 0


def test_a_bundle_of_an_unknown_station_is_refused_where_stations_are_named(place, bundle, station):
    (intake,) = taken(place, bundle, "00" * 32)
    assert intake.outcome == "refused" and f"with the key {station.key}" in intake.sentence
    assert count(place) == 0


def test_a_bundle_of_a_newer_version_says_so(place, bundle, tmp_path):
    with zipfile.ZipFile(bundle) as container:
        files = {name: container.read(name) for name in container.namelist()}
    files[MANIFEST] = files[MANIFEST].replace(b'"version": 1', b'"version": 2')
    newer = tmp_path / "newer.mtr.zip"
    with newer.open("wb") as file:
        write_container(file, {MANIFEST: files.pop(MANIFEST), SIGNATURE: files.pop(SIGNATURE), **files})
    (intake,) = taken(place, newer)
    assert intake.outcome == "refused" and "was written by a newer version" in intake.sentence


def test_a_bundle_of_a_test_of_a_newer_version_is_named_in_the_sentence(place, tmp_path, station):
    path = measured.in_folder(tmp_path / "test", 5.0)
    scenario, _, progress = open_progress(path, SCENARIOS)
    path.write_text(path.read_text("utf-8").replace('"version": 1', '"version": 2'), encoding="utf-8")
    newer = tmp_path / "newer.mtr.zip"
    write_bundle(newer, path, scenario, progress, None, station=station)
    (intake,) = taken(place, newer)
    assert intake.outcome == "refused" and count(place) == 0
    assert f"from {newer}. It has version 2; this application reads version 1." in intake.sentence


def test_a_bundle_waits_in_the_spool_while_the_store_is_away(place, bundle, tmp_path):
    place.open()
    away = type(place)(str(tmp_path / "disk" / "store.sqlite"), spool=place.spool)
    (intake,) = taken(away, bundle)
    assert intake.outcome == "spooled"
    (tmp_path / "disk").mkdir()
    assert [each.outcome for each in away.door().take_waiting()] == ["added"]
