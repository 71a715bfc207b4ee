"""Bundles that a stranger made and signed with a key of his own: texts stay texts, and numbers are bounded."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest

from mtr_operator.cli import main
from mtr_operator.evidence.manifest import sha256_of
from mtr_operator.evidence.station_key import Station

HOSTILE = "\x1b[31m\u202e<b>\nx: intact, signed by YOURS\x9b\x00"


@pytest.fixture(name="signed")
def signed_fixture(tmp_path):
    """Folder of an unpacked bundle whose manifest has the given entries, signed with the stranger's key."""
    def make(**entries):
        station, folder = Station(tmp_path / "stranger"), tmp_path / "bundle"
        folder.mkdir()
        (folder / "a.txt").write_bytes(b"a")
        manifest = {"format": "mtr evidence bundle", "version": 1, "created": "2026-11-29T10:00:00+00:00",
                    "station": "cell 1", "key": station.key, "number": 1, "before": "",
                    "files": {"a.txt": {"size": 1, "sha256": sha256_of(b"a")}}}
        content = json.dumps({**manifest, **entries}).encode()
        (folder / "manifest.json").write_bytes(content)
        (folder / "manifest.sig").write_text(json.dumps(
            {"algorithm": "Ed25519", "key": station.key, "signature": station.sign(content)}))
        return folder
    return make


def test_manifest_as_it_is_written_is_intact(signed, capsys):
    assert main(["verify", str(signed())]) == 0
    assert "intact, 1 files; bundle 1 of cell 1, signed 2026-11-29" in capsys.readouterr().out


def test_name_of_a_station_is_shown_on_one_line_without_control_characters(signed, capsys):
    assert main(["verify", str(signed(station=HOSTILE))]) == 0
    line, end = capsys.readouterr().out.split("\n")
    assert not end and line.isprintable() and "<b> x: intact, signed by YOURS" in line


def test_name_of_a_station_is_cut(signed, capsys):
    assert main(["verify", str(signed(station="s" * 10 ** 6))]) == 0
    assert len(capsys.readouterr().out) < 5000


@pytest.mark.parametrize("entries", [
    {"number": -1}, {"number": 10 ** 30}, {"number": "1"}, {"number": 1.5}, {"number": True}, {"before": "../x"},
    {"before": None}, {"created": "=1+1"}, {"created": HOSTILE}, {"created": 5}, {"station": None},
    {"station": ["a"]}, {"files": []}, {"files": {"a.txt": {"size": -1, "sha256": "00"}}},
    {"files": {"a.txt": {"size": "1", "sha256": ""}}},
    {"key": "=1"}, {"format": "another"}], ids=str)
def test_entry_of_another_kind_is_not_intact(signed, capsys, entries):
    assert main(["verify", str(signed(**entries))]) == 3
    captured = capsys.readouterr()
    assert "cannot be read" in captured.err and not captured.out and captured.err[:-1].isprintable()


def test_bundle_of_a_later_version_is_named_as_such(signed, capsys):
    assert main(["verify", str(signed(version=99))]) == 3
    assert "was written by a later version of the application" in capsys.readouterr().err


def test_names_of_files_are_shown_without_control_characters(signed, capsys):
    folder = signed(files={HOSTILE: {"size": 1, "sha256": "0" * 64}})
    (folder / "b\x1b[31m.txt").write_bytes(b"b")
    assert main(["verify", str(folder)]) == 3
    assert all(line.isprintable() for line in capsys.readouterr().err.splitlines())
