"""The chain of a station's bundles forks nowhere unseen, and no bundle is larger than it looks."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import json
import tracemalloc
import zipfile

import measured
import pytest

from mtr_operator.domain.errors import OutputError
from mtr_operator.evidence.bundle import BundleWatch, write_bundle
from mtr_operator.evidence.manifest import MANIFEST, SIGNATURE, Manifest, entry_of_path
from mtr_operator.evidence.station_key import Station, StationKeyError
from mtr_operator.evidence.verification import chain_problems, is_newer, verify_bundle


@pytest.fixture(name="station")
def station_fixture(tmp_path):
    """A station of this test's own."""
    return Station(tmp_path / "station")


@pytest.fixture(name="bundle")
def bundle_fixture(station, tmp_path, monkeypatch):
    """bundle(name, watch): the path of a new bundle, which has no report: that takes its time."""
    monkeypatch.setattr("mtr_operator.evidence.contents.report_files", lambda *_: {})
    path, side = measured.in_folder(tmp_path / "test", 5.0), measured.side(5.0)

    def bundle(name, watch=None):
        target = tmp_path / f"{name}.mtr.zip"
        write_bundle(target, path, side.scenario, side.progress, None, station=station, watch=watch)
        return target
    return bundle


def test_two_bundles_of_one_number_are_told_in_every_order_and_one_given_twice_is_not(bundle, station, tmp_path):
    first = verify_bundle(bundle("1"))
    newest = station.newest
    second = verify_bundle(bundle("2"))
    station.append(newest)
    (tmp_path / "test" / "progress.journal").write_bytes(b"")
    other = verify_bundle(bundle("2x"))
    third = verify_bundle(bundle("3"))
    assert second.is_intact and other.is_intact and second.digest != other.digest
    for given in itertools.permutations((first, second, other, third)):
        assert chain_problems(given) == ["There are 2 different bundles 2 of the station: one of them was made anew."]
    assert chain_problems([first, second, second]) == [] == chain_problems([first, other, third])
    problem, = chain_problems([first, second, third])
    assert "Bundle 3 of the station does not follow its bundle 2" in problem


def test_bundles_that_are_written_at_once_get_one_number_after_the_other(bundle, station, monkeypatch):
    monkeypatch.setattr("mtr_operator.evidence.station_key.PATIENCE_S", 0.0)
    refused = []

    class Meanwhile(BundleWatch):
        """Has another bundle written when this one is on its way."""

        def done(self, share):
            """See BundleWatch."""
            if not refused:
                with pytest.raises(StationKeyError, match="write this one when it has ended") as caught:
                    bundle("b")
                refused.append(caught)
    found = [verify_bundle(bundle("a", Meanwhile())), verify_bundle(bundle("b"))]
    assert refused and [each.manifest.number for each in found] == [1, 2] and chain_problems(found) == []
    assert station.newest.number == 2


def test_bundle_whose_link_cannot_be_kept_is_not_left(bundle, station, tmp_path, monkeypatch):
    def fail(*_):
        raise OutputError("Full.")
    monkeypatch.setattr("mtr_operator.evidence.station_key.write_bytes", fail)
    with pytest.raises(OutputError, match="Full"):
        bundle("a")
    assert not (tmp_path / "a.mtr.zip").exists() and station.newest is None


def signed(station, path, packing, files):
    """A container of these files with a good manifest of them."""
    manifest = Manifest("2026", "here", station.key, 1, "", {name: entry_of_path(file) for name, file in files.items()})
    signature = {"algorithm": "Ed25519", "key": station.key, "signature": station.sign(manifest.content())}
    with zipfile.ZipFile(path, "w", packing) as container:
        container.writestr(MANIFEST, manifest.content())
        container.writestr(SIGNATURE, json.dumps(signature))
        for name, file in files.items():
            container.write(file, name)


def test_nothing_is_unpacked_of_a_bundle_that_is_compressed(station, tmp_path, monkeypatch):
    large, bomb = tmp_path / "large", tmp_path / "bomb.mtr.zip"
    large.write_bytes(bytes(8 * 1024 * 1024))
    signed(station, bomb, zipfile.ZIP_DEFLATED, {"a.bin": large})
    monkeypatch.setattr("zipfile.ZipFile.open", lambda *_: pytest.fail("A file was opened."))
    problem, = verify_bundle(bomb).problems
    assert problem == ("manifest.json is compressed, as no file of a bundle is: it was packed anew; nothing of it was "
                       "read.")


def test_nothing_is_read_of_a_bundle_whose_files_are_the_same_bytes_again_and_again(station, tmp_path, monkeypatch):
    part, bomb = tmp_path / "part", tmp_path / "bomb.mtr.zip"
    part.write_bytes(bytes(100_000))
    signed(station, bomb, zipfile.ZIP_STORED, {f"{number:02d}": part for number in range(2)})
    with zipfile.ZipFile(bomb) as container:
        infos = container.infolist()
        entries = infos[:3] + infos[2:3]
        end = container.start_dir
    with bomb.open("r+b") as file, zipfile.ZipFile(file, "a") as container:
        file.truncate(infos[3].header_offset)
        container.filelist, container.start_dir, container._didModify = entries, infos[3].header_offset, True
    assert bomb.stat().st_size < end
    monkeypatch.setattr("zipfile.ZipFile.open", lambda *_: pytest.fail("A file was opened."))
    problem, = verify_bundle(bomb).problems
    assert problem == "Its files are larger together than it is: it is no bundle; nothing of it was read."


def test_manifest_that_unpacks_to_more_than_memory_is_no_newer_version(tmp_path):
    bomb = tmp_path / "bomb.mtr.zip"
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as container, container.open(MANIFEST, "w") as file:
        for _ in range(64):
            file.write(b" " * 1024 * 1024)
    tracemalloc.start()
    assert not is_newer(bomb)
    assert tracemalloc.get_traced_memory()[1] < 60 * 1024 * 1024
    tracemalloc.stop()
