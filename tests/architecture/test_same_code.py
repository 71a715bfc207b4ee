"""`setup/same_code.py` finds changed code and accepts changed language."""
# SPDX-License-Identifier: Apache-2.0
import importlib.util

import pytest
from project import TOP

SPEC = importlib.util.spec_from_file_location("same_code", TOP / "setup" / "same_code.py")
same_code = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(same_code)


LANGUAGE = [
    ("a.py", '"""Old."""\na = 1\n', '"""New."""\na = 1\n'),
    ("a.py", 'def f(a):\n    """Old."""\n    return a\n', 'def f(a):\n    """New."""\n    return a\n'),
    ("a.py", "a = 1  # Old.\n", "# New.\na = 1\n"),
    ("a.hpp", "int a;  // Old.\n", "/* New. */ int\na;\n"), ("a.hpp", "a = 1'000;  // Old's.", "a = 1'000;  // New's."),
    ("a.hpp", "#define A 1  // Old.\n", "/* New. */\n#define A 1\n"), ("a.hpp", 'f("a" "b");', 'f("ab");'),
    ("a.hpp", "/* Old.\n# a */ b();", "b();"),
]
TEXTS = [
    ("a.py", 'raise ValueError("Old.")\n', 'raise ValueError(\n    "New "\n    "words.")\n'),
    ("a.py", 'f"{a:.1f} old {b}"\n', 'f"New {a:.1f} and {b}"\n'), ("a.py", 'a = b["old"]\n', 'a = b["new"]\n'),
    ("a.hpp", 'f("old");', 'f("new" "er");'), ("a.hpp", 'f(R"(old")");', 'f("new");'),
]
CODE = [
    ("a.py", "a = 1\n", "a = 2\n"), ("a.py", "a = b'1'\n", "a = b'2'\n"), ("a.py", 'a = "1"\n', "a = 1\n"),
    ("a.py", 'a = f"{b} {c}"\n', 'a = f"{c} {b}"\n'), ("a.py", "a = b\n", "a = c\n"), ("a.py", "a()\n", ""),
    ("a.py", 'a = ("1", "2")\n', 'a = ("1" "2")\n'),
    ("a.hpp", "int a;", "int b;"), ("a.hpp", "a = 1'000;", "a = 1'001;"), ("a.hpp", "c = 'a';", "c = 'b';"),
    ("a.hpp", 'f("//", a);', 'f("//", b);'), ("a.hpp", "a + b", "a - b"), ("a.hpp", "// a\nb();", "// a b();"),
    ("a.hpp", "#define A\nb();", "#define A b();"), ("a.hpp", "#define A \\\n  1\n", "#define A \\\n  2\n"),
]


@pytest.mark.parametrize("name, before, after", LANGUAGE)
def test_comments_and_docstrings_may_change(name, before, after):
    assert same_code.code(name, before, True) == same_code.code(name, after, True)


@pytest.mark.parametrize("name, before, after", TEXTS)
def test_texts_may_change_only_if_wanted(name, before, after):
    assert same_code.code(name, before, False) == same_code.code(name, after, False)
    assert same_code.code(name, before, True) != same_code.code(name, after, True)


@pytest.mark.parametrize("keep_texts", [True, False])
@pytest.mark.parametrize("name, before, after", CODE)
def test_code_may_not_change(name, before, after, keep_texts):
    assert same_code.code(name, before, keep_texts) != same_code.code(name, after, keep_texts)


@pytest.fixture
def commit(tmp_path, monkeypatch):
    """Two files in a repository of the test."""
    monkeypatch.setattr(same_code, "TOP", tmp_path)
    same_code.git("init", "-q")
    for name in ("language.py", "code.py"):
        (tmp_path / name).write_text('a = "1"  # Old.\n', encoding="utf-8")
    same_code.git("add", ".")
    same_code.git("-c", "user.name=a", "-c", "user.email=a@b.c", "commit", "-qm", "tests: add two files")
    (tmp_path / "language.py").write_text('a = "1"  # New.\n', encoding="utf-8")
    return tmp_path


def test_changed_code_is_named(commit, capsys):
    assert same_code.main(["HEAD"]) == 0
    (commit / "code.py").write_text('a = "2"  # Old.\n', encoding="utf-8")
    assert same_code.main(["--texts", "HEAD"]) == 0
    assert same_code.main(["HEAD"]) == 1
    assert capsys.readouterr().out == "code.py: the code differs.\n"


def test_removed_and_added_files_are_named(commit, capsys):
    (commit / "code.py").unlink()
    (commit / "new.py").write_text("a = 1\n", encoding="utf-8")
    same_code.git("add", "--intent-to-add", "new.py")
    assert same_code.main(["--texts", "HEAD"]) == 1
    assert capsys.readouterr().out == "code.py: the code differs.\nnew.py: the code differs.\n"


@pytest.mark.parametrize("arguments", [[], ["--help"], ["--texts"], ["no-such-commit"]])
def test_what_cannot_be_compared_has_status_2(arguments, capsys):
    assert same_code.main(arguments) == 2
    assert capsys.readouterr().err
