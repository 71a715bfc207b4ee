"""Checks commit messages: `area: imperative`, at most 72 characters, and a body that is set off by an empty line.

Usage: commit_message.py FILE | --branch

FILE has one message, as git passes it to the hook commit-msg. --branch checks the commits that main lacks; there are
none without git or without a branch main. Exit status: 0 if all are good, 1 if one is not.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import subprocess
import sys
from typing import Iterator, List, Optional

MAX_SUBJECT = 72
SUBJECT = re.compile(r"[\w.-]+(?:[ ,/]+[\w.-]+)*: (?P<first>[a-z][\w-]*)(?:,? .*)?")
# Verbs with the ending of another form.
VERBS = {"address", "bring", "bypass", "compress", "cross", "discuss", "embed", "exceed", "express", "feed", "focus",
         "guess", "miss", "need", "pass", "ping", "press", "process", "seed", "shed", "speed", "stress", "string",
         "suppress"}
OTHER_FORM = re.compile(r"\w+(?:s|ed|ing)")
NO_VERB = {"a", "an", "the", "no", "it", "its", "this", "that", "some", "more", "new", "what", "when", "if", "and"}
# Written by git.
GENERATED = re.compile(r"(?:Merge|Revert|fixup!|squash!|amend!) ?")
MAIN = ("origin/main", "main")


def main(arguments: List[str]) -> int:
    """Print a line for each fault."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    if arguments[0] == "--branch":
        messages = list(branch())
    else:
        messages = [pathlib.Path(arguments[0]).read_text(encoding="utf-8")]
    faults = [f"{message.partition(chr(10))[0]}: {fault}" for message in messages
              for fault in filter(None, [fault_of(message)])]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


def fault_of(message: str) -> Optional[str]:
    """Sentence on the first fault of a message, None without one."""
    lines = [line for line in message.splitlines() if not line.startswith("#")]
    subject = lines[0] if lines else ""
    if GENERATED.match(subject):
        return None
    if len(subject) > MAX_SUBJECT:
        return f"The subject has {len(subject)} characters; at most {MAX_SUBJECT} are allowed."
    found = SUBJECT.fullmatch(subject)
    if found is None:
        return "The subject must be `area: imperative`, for example \"dispatcher: close the socket on timeout\"."
    first = found["first"]
    if first in NO_VERB or (OTHER_FORM.fullmatch(first) and first not in VERBS):
        return f"The subject must begin with an imperative behind the area, not with \"{first}\"."
    if len(lines) > 1 and lines[1].strip():
        return "An empty line must separate subject and body."
    return None


def branch() -> Iterator[str]:
    """Messages of the commits that main lacks."""
    for base in MAIN:
        command = ["git", "log", "--format=%B%x00", f"{base}..HEAD"]
        listed = subprocess.run(command, text=True, capture_output=True, check=False)
        if listed.returncode == 0:
            yield from (message.strip() for message in listed.stdout.split("\0") if message.strip())
            return


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
