"""Commit messages are `area: imperative`."""
# SPDX-License-Identifier: Apache-2.0
import importlib.util
import subprocess

import pytest
from project import TOP

SCRIPT = TOP / "setup" / "commit_message.py"


@pytest.fixture(scope="module")
def checker():
    """The script as a module."""
    spec = importlib.util.spec_from_file_location("commit_message", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("message", [
    "dispatcher: close the socket on timeout", "state machine, planner: hold outside the area", "README: fix a link",
    "docs: add a page\n\nBecause.", "mtr_core: press twice", "tests/gui: bring the window up", "Merge branch 'a'",
    "fixup! docs: x", "proto: read, check and keep a field", "docs: need one page less\n\nBody.\n# a comment of git"])
def test_message_is_accepted(checker, message):
    assert checker.fault_of(message) is None


@pytest.mark.parametrize("message, word", [
    ("", "area"), ("close the socket", "area"), ("dispatcher:close", "area"), ("dispatcher: Close the socket", "area"),
    ("dispatcher: closes the socket", "closes"), ("dispatcher: closed the socket", "closed"),
    ("docs: adding a page", "adding"), ("operator: a notice is no defect", '"a"'), ("docs: " + "x" * 67, "73 char"),
    ("docs: add a page\nBecause.", "empty line")])
def test_message_is_refused_with_the_reason(checker, message, word):
    assert word in checker.fault_of(message)


def git(folder, *arguments):
    """Run git with an identity of its own."""
    subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b.example", *arguments], cwd=folder, check=True,
                   capture_output=True)


def test_branch_is_checked_from_main_on(checker, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    git(tmp_path, "init", "-b", "main")
    git(tmp_path, "commit", "--allow-empty", "-m", "Older messages remain")
    git(tmp_path, "checkout", "-b", "work")
    assert checker.main(["--branch"]) == 0
    git(tmp_path, "commit", "--allow-empty", "-m", "docs: add a page")
    assert checker.main(["--branch"]) == 0
    git(tmp_path, "commit", "--allow-empty", "-m", "docs: pages added")
    assert checker.main(["--branch"]) == 1 and "pages" in capsys.readouterr().out


def test_folder_without_git_has_no_commits(checker, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert checker.main(["--branch"]) == 0


def test_file_of_the_hook_is_read(checker, tmp_path, capsys):
    (tmp_path / "message").write_text("docs: adds a page", encoding="utf-8")
    assert checker.main([str(tmp_path / "message")]) == 1 and "adds" in capsys.readouterr().out
