"""Reports files whose code differs between a commit and the checkout; comments, docstrings and texts may differ.

Usage: same_code.py COMMIT [PATH ...]

Python files are compared by their syntax trees without docstrings and with every string constant replaced by a
placeholder, C++ files by their tokens without comments and with every string literal replaced. Exit status: 0 if all
are equal, 1 if one differs, 2 if git fails. Use it for changes of language; tests verify texts that are data.
"""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
import subprocess
import sys
from typing import List

TOP = pathlib.Path(__file__).resolve().parent.parent
PYTHON, CPP = {".py"}, {".cpp", ".hpp", ".h", ".c", ".cc", ".ino"}
# Comments, raw strings, strings, characters (a digit separator is none), words and other single characters.
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'
                   r"(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|\w+|\S", re.DOTALL)
TEXT = "<text>"


def main(arguments: List[str]) -> int:
    """Compare the changed files; print the names of those that differ."""
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    commit, paths = arguments[0], arguments[1:]
    try:
        changed = git("diff", "--name-only", "--diff-filter=M", "-z", commit, "--", *paths).split("\0")
        different = [name for name in changed if is_code(name)
                     and code(name, git("show", f"{commit}:{name}")) != code(name, read(name))]
    except subprocess.CalledProcessError as error:
        print(error.stderr.strip(), file=sys.stderr)
        return 2
    for name in different:
        print(f"{name}: the code differs.")
    return 1 if different else 0


def git(*arguments: str) -> str:
    """Output of a git command in the checkout."""
    return subprocess.run(("git", *arguments), cwd=TOP, check=True, capture_output=True, text=True).stdout


def read(name: str) -> str:
    """Text of a file of the checkout."""
    return (TOP / name).read_text(encoding="utf-8")


def is_code(name: str) -> bool:
    """True for Python and C++ files."""
    return pathlib.PurePath(name).suffix in PYTHON | CPP


def code(name: str, text: str) -> List[str]:
    """Comparable form of a file: its code without comments, docstrings and contents of texts."""
    return [python(text)] if pathlib.PurePath(name).suffix in PYTHON else cpp(text)


def python(text: str) -> str:
    """Syntax tree without docstrings; joined and formatted texts keep their expressions, in order."""
    return ast.dump(_WithoutTexts().visit(ast.parse(text)))


class _WithoutTexts(ast.NodeTransformer):
    def visit_Expr(self, node: ast.Expr) -> object:
        """Drop docstrings."""
        is_text = isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        return None if is_text else self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        """Replace texts."""
        return ast.Constant(TEXT) if isinstance(node.value, str) else node

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        """Keep only the expressions of a formatted text."""
        return ast.JoinedStr([self.visit(part) for part in node.values if not isinstance(part, ast.Constant)])


def cpp(text: str) -> List[str]:
    """Tokens without comments; adjacent string literals count as one."""
    tokens: List[str] = []
    for match in TOKEN.finditer(text):
        token = match[0]
        if token.startswith(("//", "/*")):
            continue
        if token.startswith(('"', 'R"')):
            if tokens[-1:] != [TEXT]:
                tokens.append(TEXT)
        else:
            tokens.append(token)
    return tokens


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
