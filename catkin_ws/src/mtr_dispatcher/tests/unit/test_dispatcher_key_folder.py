"""The robot's key folder: contents, permissions, and a failing disk."""
# SPDX-License-Identifier: Apache-2.0
import errno
import os

import pytest
import zmq

from mtr_dispatcher.access.authorised_keys import AuthorisedKeys, Entry, KeysError, Role
from mtr_dispatcher.access.command_line import DONE, ERROR, keys
from mtr_dispatcher.access.gate import Gate
from mtr_dispatcher.access.key_folder import AUTHORISED_KEYS, OWN_KEYS, KeyFolder


def public_key(number=0):
    return f"{number:040d}"


def entry(name="Jana", number=1):
    return Entry(name, Role.CONTROLLER, "2026-11-23", public_key(number))


JANA = AuthorisedKeys((entry(),))


def test_key_pair_of_zeromq_is_what_is_kept(tmp_path):
    kept = KeyFolder(tmp_path).own_keys()
    assert zmq.curve_public(kept.secret) == kept.public


def test_keys_of_the_robot_are_made_once_for_their_owner_alone(tmp_path):
    folder = KeyFolder(tmp_path / "keys")
    assert folder.own_keys() == folder.own_keys() == KeyFolder(tmp_path / "keys").own_keys()
    folder.change(lambda known: JANA)
    assert {path.stat().st_mode & 0o777 for path in (tmp_path / "keys").iterdir() if path.name[0] != "."} == {0o600}
    assert (tmp_path / "keys").stat().st_mode & 0o777 == 0o700


def test_keys_and_list_are_said_to_be_there_when_their_names_are_safe_too(tmp_path, monkeypatch):
    synced, fsync = [], os.fsync

    def spied(descriptor):
        fsync(descriptor)
        synced.append((os.path.realpath(f"/proc/self/fd/{descriptor}"), sorted(
            path.name for path in tmp_path.iterdir() if path.name in (OWN_KEYS, AUTHORISED_KEYS))))
    monkeypatch.setattr(os, "fsync", spied)
    folder = KeyFolder(tmp_path)
    folder.own_keys()
    assert synced[-1] == (str(tmp_path), [OWN_KEYS])
    folder.change(lambda known: JANA)
    assert synced[-1] == (str(tmp_path), sorted((OWN_KEYS, AUTHORISED_KEYS)))
    folder.change(lambda known: known.without("Jana"))
    assert [path == str(tmp_path) for path, _ in synced] == [False, True] * 3


def test_full_disk_is_a_sentence_and_leaves_nothing(tmp_path, monkeypatch):
    def full(_descriptor):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    monkeypatch.setattr(os, "fsync", full)
    folder = KeyFolder(tmp_path)
    for act in (folder.own_keys, lambda: folder.change(lambda known: JANA)):
        with pytest.raises(KeysError, match=r"cannot be written.*No space left on device\."):
            act()
    assert [path.name for path in tmp_path.iterdir()] == [f".{AUTHORISED_KEYS}.lock"]


def test_secret_key_that_others_can_read_is_not_used(tmp_path):
    folder = KeyFolder(tmp_path)
    folder.own_keys()
    os.chmod(tmp_path / OWN_KEYS, 0o644)
    with pytest.raises(KeysError, match="chmod 600"):
        folder.own_keys()


@pytest.mark.parametrize("content", [b"", b"public x\nsecret y\n", b"\xff\xfe"])
def test_damaged_key_file_is_a_sentence(tmp_path, content):
    (tmp_path / OWN_KEYS).write_bytes(content)
    os.chmod(tmp_path / OWN_KEYS, 0o600)
    with pytest.raises(KeysError, match=OWN_KEYS):
        KeyFolder(tmp_path).own_keys()


def test_change_of_the_list_holds_at_once_and_a_damaged_one_lets_nobody_in(tmp_path):
    folder, other = KeyFolder(tmp_path), KeyFolder(tmp_path)
    assert folder.authorised() == AuthorisedKeys()
    other.change(lambda known: JANA)
    assert folder.authorised() == JANA
    (tmp_path / AUTHORISED_KEYS).write_text("keys: nonsense here\n", encoding="utf-8")
    assert folder.authorised() == AuthorisedKeys() and "Nobody is accepted" in folder.distrust
    with pytest.raises(KeysError, match="Nobody is accepted"):
        folder.change(lambda known: JANA)


def test_list_that_others_can_write_lets_nobody_in(tmp_path):
    folder = KeyFolder(tmp_path)
    folder.change(lambda known: JANA)
    os.chmod(tmp_path / AUTHORISED_KEYS, 0o666)
    assert folder.authorised() == AuthorisedKeys() and "chmod 600" in folder.distrust


@pytest.mark.parametrize("rights", [0o777, 0o770, 0o702])
def test_folder_that_others_can_write_lets_nobody_in(tmp_path, rights):
    folder = KeyFolder(tmp_path)
    folder.change(lambda known: JANA)
    folder.own_keys()
    assert folder.authorised() == JANA
    os.chmod(tmp_path, rights)
    assert folder.authorised() == AuthorisedKeys() and f"chmod 700 {tmp_path}." in folder.distrust
    for act in (folder.own_keys, lambda: folder.change(lambda known: JANA)):
        with pytest.raises(KeysError, match="Others may write .*; say chmod 700"):
            act()
    os.chmod(tmp_path, 0o755)
    assert folder.authorised() == JANA and not folder.distrust and folder.own_keys()


def test_folder_is_for_its_owner_alone_where_files_are_for_the_group(tmp_path):
    before = os.umask(0o002)
    try:
        folder = KeyFolder(tmp_path / "ros" / "keys")
        folder.change(lambda known: JANA)
        assert folder.own_keys() and folder.authorised() == JANA
    finally:
        os.umask(before)


def test_list_that_could_not_be_read_once_is_read_again(tmp_path, monkeypatch):
    folder, other = KeyFolder(tmp_path), KeyFolder(tmp_path)
    other.change(lambda known: JANA)
    gate = Gate(folder.authorised, 50.0, lambda: 0.0, lambda: folder.distrust)
    other.change(lambda known: known.with_entry(entry("Petr", 2)))

    def none_left(*_arguments, **_options):
        raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))
    with monkeypatch.context() as patch:
        patch.setattr("builtins.open", none_left)
        assert not gate.admits(public_key(1)) and gate.has_lost_keys()
        assert gate.why_lost().endswith("cannot be used. Too many open files.")
    assert [gate.admits(public_key(number)) for number in (1, 2)] == [True, True]
    assert not gate.has_lost_keys() and not folder.distrust
    other.change(lambda known: known.without("Jana"))
    assert gate.has_lost_keys() and gate.why_lost() == "A key was revoked."


def test_list_that_is_gone_after_it_could_not_be_read_is_empty_and_can_be_written(tmp_path):
    folder = KeyFolder(tmp_path)
    (tmp_path / AUTHORISED_KEYS).mkdir()
    assert folder.authorised() == AuthorisedKeys() and "Is a directory." in folder.distrust
    (tmp_path / AUTHORISED_KEYS).rmdir()
    assert folder.change(lambda known: JANA) == folder.authorised() == JANA


def test_command_lists_and_revokes(tmp_path, capsys):
    KeyFolder(tmp_path).change(lambda known: JANA)
    assert keys(["--keys", str(tmp_path)]) == DONE and "Jana" in capsys.readouterr().out
    assert keys(["--revoke", "Jana"], {"key_folder": str(tmp_path)}) == DONE
    assert KeyFolder(tmp_path).authorised() == AuthorisedKeys()
    assert keys(["--revoke", "Jana", "--keys", str(tmp_path)]) == ERROR
    assert "there are: none" in capsys.readouterr().err
