"""Counts unidiomatic phrases in comments, docstrings, texts and names of the checkout.

Usage: wording.py [--list PATTERN] [--update]

Without options it prints the count of each area. --list prints the places of one pattern. --update lowers the limits in
wording_limits.yaml to today's counts; a limit never rises by itself.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import ast
import collections
import functools
import io
import pathlib
import re
import sys
import tokenize
from typing import Collection, Dict, Iterator, Mapping, NamedTuple, Tuple

import yaml
from project import TOP, tracked

LIMITS = pathlib.Path(__file__).with_name("wording_limits.yaml")
# Phrase -> pattern. CONTRIBUTING.md has the replacements.
PHRASES = {
    "speech": r"\b(?:tells?|told|says?|said|hears?|heard|obeys?|obeyed|speaks?|spoken)\b",
    "anew": r"\b(?:anew|of before|any more|goe?s? on|went on|gone on|mend(?:s|ed)?)\b",
    "stand": r"\b(?:stands?|stood)\b(?! for)",
    "beside": r"\bbesides?\b",
    "take for": r"\b(?:takes?|taken|took)(?: \w+)? (?:for|up)\b",
    "is no": r"\b(?:is|are|was|were|be) no (?!longer\b)",
    "person": r"\b(?:nobody|somebody|anybody|whoever)\b",
    "pronoun": r"\b(?:that of|those of|at hand|by now|so much|so long|so often|so many)\b",
    "where": r"\bwhere (?:it|there|nothing|they|one|no|something|all|what)\b",
}
VERBLESS = "verbless"
PATTERNS = {name: re.compile(pattern, re.IGNORECASE) for name, pattern in PHRASES.items()}
PATTERNS[VERBLESS] = re.compile(r"^(?:Of (?:an?|the|each|one|its?|this|all)|What|Whether|Whoever|How|Who)\b[^?]*$",
                                re.MULTILINE)
# Parts of identifiers.
WORDS = re.compile(r"(?:^|_)(?:told|said|tells?|says|heard|obeys?|anew|gone|at_hand|take_up|meant|begun)(?:_|$)")
NAME = "name"
CPP_COMMENT = re.compile(r"//+[/!<]* ?(?:@\w+ )?(.*)$|/\*+(.*?)\*/", re.MULTILINE)
TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
MARKED = re.compile(r"```.*?```|`[^`\n]*`|\]\([^)]*\)", re.DOTALL)
PYTHON, CPP = (".py",), (".cpp", ".hpp")
COMMENTED = (".yaml", ".launch", ".msg", ".srv", ".proto", ".test", ".sh", ".bash", ".xacro")
# Dated measurements and the diary remain as they were written.
EXCLUDED = ("docs/lab-notebook/", "tests/architecture/wording")


class Piece(NamedTuple):
    """Text of a file. line: its first line. is_text: a string of the program, where a phrase may begin anywhere."""

    line: int
    text: str
    is_text: bool = False


class Place(NamedTuple):
    """Found phrase: file below the checkout, line and text."""

    file: str
    line: int
    text: str


def main() -> int:
    """Print the counts, or the places of a pattern."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", choices=[*PATTERNS, NAME])
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    if options.list:
        for file, source in sources():
            for place in find([options.list], file, source):
                print(f"{place.file}:{place.line}: {' '.join(place.text.split())[:120]}")
        return 0
    counts = count_areas()
    if options.update:
        write_limits({area: min(count, limits().get(area, count)) for area, count in counts.items()})
    print("\n".join(f"{count:6d} {area}" for area, count in counts.items()))
    return 0


def limits() -> Dict[str, int]:
    """Largest allowed count of each area; an area without an entry has none."""
    return yaml.safe_load(LIMITS.read_text(encoding="utf-8")) if LIMITS.exists() else {}


def write_limits(counts: Dict[str, int]) -> None:
    """Write the limits of areas with phrases."""
    lines = [f"{area}: {count}\n" for area, count in sorted(counts.items()) if count]
    head = "# Limits of unidiomatic phrases by area; `python tests/architecture/wording.py --update` lowers them.\n"
    LIMITS.write_text(head + "".join(lines), encoding="utf-8")


@functools.lru_cache(maxsize=None)
def count_areas() -> Mapping[str, int]:
    """Number of phrases of each area that has some."""
    counts: Dict[str, int] = collections.Counter()
    for file, source in sources():
        counts[area(file)] += sum(1 for _ in find((*PATTERNS, NAME), file, source))
    return {each: count for each, count in sorted(counts.items()) if count}


def area(file: str) -> str:
    """Package, or folder, to which a file belongs."""
    parts = file.split("/")
    depth = 3 if parts[0] in ("catkin_ws", "operator_gui") else 1
    return "/".join(parts[:min(depth, len(parts) - 1)]) or parts[0]


def sources() -> Iterator[Tuple[str, str]]:
    """Name below the checkout, and text, of each file that is counted."""
    for path in tracked("*.py", "*.cpp", "*.hpp", "*.md", *(f"*{suffix}" for suffix in COMMENTED)):
        file = path.relative_to(TOP).as_posix()
        if not file.startswith(EXCLUDED) and "/translations/" not in file:
            yield file, path.read_text(encoding="utf-8")


def find(patterns: Collection[str], file: str, source: str) -> Iterator[Place]:
    """Places of the patterns in the source of a file."""
    if NAME in patterns:
        yield from (Place(file, line, each) for line, each in names(file, source) if WORDS.search(each))
    wanted = [pattern for pattern in patterns if pattern != NAME]
    for piece in pieces(file, source) if wanted else ():
        for pattern in wanted:
            if not (piece.is_text and pattern == VERBLESS):
                for _ in PATTERNS[pattern].finditer(piece.text):
                    yield Place(file, piece.line, piece.text)


def pieces(file: str, source: str) -> Iterator[Piece]:
    """Comments, docstrings, texts and prose."""
    if file.endswith(PYTHON):
        yield from python_pieces(source)
    elif file.endswith(CPP):
        yield from cpp_pieces(source)
    elif file.endswith(".md"):
        blank = MARKED.sub(lambda found: "\n" * found.group().count("\n"), source)
        yield from (Piece(number, line) for number, line in enumerate(blank.split("\n"), 1))
    else:
        for number, line in enumerate(source.split("\n"), 1):
            _, mark, text = line.partition("//" if file.endswith(".proto") else "#")
            yield from [Piece(number, text.strip())] if mark else []
            yield from (Piece(number, text, True) for text in re.findall(r'doc="([^"]*)"', line))


def python_pieces(source: str) -> Iterator[Piece]:
    """Comments, docstrings and texts of several words."""
    docstrings = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            text = ast.get_docstring(node)
            if text:
                docstrings.add(node.body[0].lineno)
                yield Piece(node.body[0].lineno, text)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value.strip():
            if node.lineno not in docstrings:
                yield Piece(node.lineno, node.value, True)
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield Piece(token.start[0], token.string.lstrip("# "))


def cpp_pieces(source: str) -> Iterator[Piece]:
    """Comments and texts."""
    for found in CPP_COMMENT.finditer(source):
        yield Piece(source.count("\n", 0, found.start()) + 1, found.group(1) or found.group(2) or "")
    for found in TEXT.finditer(source):
        if " " in found.group(1).strip():
            yield Piece(source.count("\n", 0, found.start()) + 1, found.group(1), True)


def names(file: str, source: str) -> Iterator[Tuple[int, str]]:
    """Line and name of each definition of a Python file."""
    if not file.endswith(PYTHON):
        return
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.lineno, node.name
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.attr


if __name__ == "__main__":
    sys.exit(main())
