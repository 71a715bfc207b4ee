"""Reports files whose code differs between a commit and the checkout; comments and docstrings may differ.

Usage: same_code.py [--texts] COMMIT [PATH ...]

Python files are compared by their syntax trees without docstrings, C++ files by their tokens without comments. With
--texts, texts may differ as well: messages, labels and help. Keys, names and patterns are texts too, so only tests
verify them then. Added and removed files differ. Exit status: 0 if all are equal, 1 if one differs, 2 if git fails.
"""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
import subprocess
import sys
from typing import List

TOP = pathlib.Path(__file__).resolve().parent.parent
TEXTS = "--texts"
PYTHON, CPP = {".py"}, {".cpp", ".hpp", ".h", ".c", ".cc", ".ino"}
# Preprocessor lines end with their line, so each is one token.
DIRECTIVE = r"^[ \t]*\#(?:[^\n\\]|\\.)*"
COMMENT = r"//[^\n]*|/\*.*?\*/"
LITERAL = r'R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
# The quote between digits separates thousands.
CHARACTER = r"(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
TOKEN = re.compile(rf"{DIRECTIVE}|{COMMENT}|{LITERAL}|{CHARACTER}|\w+|\S", re.DOTALL | re.MULTILINE)
TEXT = "<text>"


def main(arguments: List[str]) -> int:
    """Compare the changed files; print the names of those that differ."""
    keep_texts = TEXTS not in arguments
    positional = [argument for argument in arguments if argument != TEXTS]
    if not positional or positional[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    commit, paths = positional[0], positional[1:]
    try:
        different = [name for name in changed(commit, paths) if not is_same(commit, name, keep_texts)]
    except subprocess.CalledProcessError as error:
        print(error.stderr.strip(), file=sys.stderr)
        return 2
    for name in different:
        print(f"{name}: the code differs.")
    return 1 if different else 0


def changed(commit: str, paths: List[str]) -> List[str]:
    """Changed, added and removed files of code."""
    listed = git("diff", "--name-only", "--no-renames", "-z", commit, "--", *paths).split("\0")
    return [name for name in listed if pathlib.PurePath(name).suffix in PYTHON | CPP]


def is_same(commit: str, name: str, keep_texts: bool) -> bool:
    """True if the file exists on both sides with equal code."""
    if not (TOP / name).exists() or not git("ls-tree", commit, "--", name):
        return False
    before, after = git("show", f"{commit}:{name}"), (TOP / name).read_text(encoding="utf-8")
    return code(name, before, keep_texts) == code(name, after, keep_texts)


def git(*arguments: str) -> str:
    """Output of a git command in the checkout."""
    return subprocess.run(("git", *arguments), cwd=TOP, check=True, capture_output=True, text=True).stdout


def code(name: str, text: str, keep_texts: bool) -> List[str]:
    """Comparable form of a file: code without comments and docstrings, with or without the contents of texts."""
    return [python(text, keep_texts)] if pathlib.PurePath(name).suffix in PYTHON else cpp(text, keep_texts)


def python(text: str, keep_texts: bool) -> str:
    """Syntax tree without docstrings."""
    tree = _WithoutDocstrings().visit(ast.parse(text))
    return ast.dump(tree if keep_texts else _WithoutTexts().visit(tree))


class _WithoutDocstrings(ast.NodeTransformer):
    def visit_Expr(self, node: ast.Expr) -> object:
        """Drop statements that are a text alone."""
        is_text = isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        return None if is_text else self.generic_visit(node)


class _WithoutTexts(ast.NodeTransformer):
    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        """Replace texts."""
        return ast.Constant(TEXT) if isinstance(node.value, str) else node

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        """Keep only the expressions of a formatted text, in order."""
        return ast.JoinedStr([self.visit(part) for part in node.values if not isinstance(part, ast.Constant)])


def cpp(text: str, keep_texts: bool) -> List[str]:
    """Tokens without comments; adjacent string literals are joined."""
    tokens: List[str] = []
    for match in TOKEN.finditer(text):
        token = match[0]
        if token.startswith(("//", "/*")):
            continue
        if token.lstrip().startswith("#"):
            tokens.append(" ".join(re.sub(COMMENT, " ", token, flags=re.DOTALL).split()))
        elif token.startswith(('"', 'R"')) and not keep_texts:
            if tokens[-1:] != [TEXT]:
                tokens.append(TEXT)
        elif token.startswith('"') and tokens and tokens[-1].startswith('"'):
            tokens[-1] = tokens[-1][:-1] + token[1:]
        else:
            tokens.append(token)
    return tokens


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
