"""`setup/same_code.py` finds changed code and accepts changed language."""
# SPDX-License-Identifier: Apache-2.0
import importlib.util

import pytest
from project import TOP

SPEC = importlib.util.spec_from_file_location("same_code", TOP / "setup" / "same_code.py")
same_code = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(same_code)


@pytest.mark.parametrize("before, after", [
    ('"""Old."""\na = 1\n', '"""New."""\na = 1\n'),
    ('def f(a):\n    """Old."""\n    return a\n', 'def f(a):\n    """New."""\n    return a\n'),
    ("a = 1  # Old.\n", "# New.\na = 1\n"),
    ('raise ValueError("Old.")\n', 'raise ValueError(\n    "New "\n    "words.")\n'),
    ('f"{a:.1f} old {b}"\n', 'f"New {a:.1f} and {b}"\n'),
])
def test_language_of_python_may_change(before, after):
    assert same_code.code("a.py", before) == same_code.code("a.py", after)


@pytest.mark.parametrize("before, after", [
    ("a = 1\n", "a = 2\n"), ("a = b'1'\n", "a = b'2'\n"), ('a = "1"\n', "a = 1\n"),
    ('a = f"{b} {c}"\n', 'a = f"{c} {b}"\n'),
    ("a = b\n", "a = c\n"), ("a()\n", ""), ('a = ("1", "2")\n', 'a = ("1" "2")\n'),
])
def test_code_of_python_may_not(before, after):
    assert same_code.code("a.py", before) != same_code.code("a.py", after)


@pytest.mark.parametrize("before, after", [
    ("int a;  // Old.\n", "/* New. */ int\na;\n"), ('f("old");', 'f("new" "er");'), ('f(R"(old")");', 'f("new");'),
    ("a = 1'000;  // Old's.", "a = 1'000;  // New's."),
])
def test_language_of_cpp_may_change(before, after):
    assert same_code.code("a.cpp", before) == same_code.code("a.cpp", after)


@pytest.mark.parametrize("before, after", [
    ("int a;", "int b;"), ("a = 1'000;", "a = 1'001;"), ("c = 'a';", "c = 'b';"), ('f("//", a);', 'f("//", b);'),
    ("a + b", "a - b"), ("// a\nb();", "// a b();"),
])
def test_code_of_cpp_may_not(before, after):
    assert same_code.code("a.hpp", before) != same_code.code("a.hpp", after)


def test_changed_file_of_a_commit_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(same_code, "TOP", tmp_path)
    same_code.git("init", "-q")
    for name in ("language.py", "code.py"):
        (tmp_path / name).write_text("a = 1  # Old.\n", encoding="utf-8")
    same_code.git("add", ".")
    same_code.git("-c", "user.name=a", "-c", "user.email=a@b.c", "commit", "-qm", "tests: add two files")
    (tmp_path / "language.py").write_text("a = 1  # New.\n", encoding="utf-8")
    assert same_code.main(["HEAD"]) == 0
    (tmp_path / "code.py").write_text("a = 2  # Old.\n", encoding="utf-8")
    assert same_code.main(["HEAD"]) == 1
    assert capsys.readouterr().out == "code.py: the code differs.\n"


@pytest.mark.parametrize("arguments", [[], ["--help"], ["no-such-commit"]])
def test_what_cannot_be_compared_has_status_2(arguments, capsys):
    assert same_code.main(arguments) == 2
    assert capsys.readouterr().err
