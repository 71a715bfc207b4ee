"""The mutants of a module: its text with one construct changed."""
# SPDX-License-Identifier: Apache-2.0
import difflib
import pathlib
from typing import Any, Iterator, List, NamedTuple, Optional

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.ast.ast_query import ASTQuery
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator

# What makes another number. Constants have a source of their own, and a test would only repeat them.
ARITHMETIC = ("NumberReplacer", "ReplaceBinaryOperator")


class Mutant(NamedTuple):
    """One change: the lines before and after, and the module's whole text with it."""

    module: str
    line: int
    before: str
    after: str
    code: str


def mutants_of(source: pathlib.Path, module: str, operators: List[str]) -> Iterator[Mutant]:
    """Every mutant of a module below source, in the order of the operators."""
    code = (source / module).read_text(encoding="utf-8")
    for name in operators:
        operator = get_operator(f"core/{name}")()
        nodes = [node for node in ast_nodes(get_ast(code)) for _ in operator.mutation_positions(node)]
        for occurrence, node in enumerate(nodes):
            if is_in_function(node) or not name.startswith(ARITHMETIC):
                yield mutant_of(module, code, mutate_code(code, operator, occurrence))


def is_in_function(node: Any) -> bool:
    """True within a function's body; its name does not begin with a capital, as a class's does."""
    name: Optional[str] = ASTQuery(node).get_definition_name()
    return name is not None and not name[0].isupper()


def mutant_of(module: str, code: str, changed: str) -> Mutant:
    """The mutant with its first changed lines."""
    before, after = code.splitlines(), changed.splitlines()
    opcodes = difflib.SequenceMatcher(None, before, after, False).get_opcodes()
    _, first, last, first_after, last_after = next(opcode for opcode in opcodes if opcode[0] != "equal")
    return Mutant(module, first + 1, " ".join(line.strip() for line in before[first:last]),
                  " ".join(line.strip() for line in after[first_after:last_after]), changed)
