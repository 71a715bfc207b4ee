"""What became of each cell, kept as soon as it is over: nothing is lost of a run that is broken off, or made in pieces.

A line of the file is one cell that was run: name, seed, commit of the checkout (with `+`: changed), time, load of the
machine, and what was wrong.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import subprocess
from datetime import datetime, timezone
from typing import Any, Dict, List, NamedTuple, Set

FILE = "cells.jsonl"
HERE = pathlib.Path(__file__).resolve().parent


class Run(NamedTuple):
    """Cells that belong together. folder: where they are kept."""

    folder: pathlib.Path
    seed: int
    commit: str

    def keep(self, cell: str, wrong: List[str]) -> None:
        """What became of a cell."""
        now = datetime.now(timezone.utc).isoformat(timespec="seconds")
        line = {"cell": cell, "seed": self.seed, "commit": self.commit, "time": now,
                "load": round(os.getloadavg()[0], 1), "wrong": wrong}
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / FILE).open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")


def right_of(folder: pathlib.Path, commit: str) -> Set[str]:
    """Cells that did as they must when they were run last on a commit."""
    path = folder / FILE
    lines: List[Dict[str, Any]] = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()
                                   ] if path.exists() else []
    newest = {line["cell"]: line["wrong"] for line in lines if line["commit"] == commit}
    return {cell for cell, wrong in newest.items() if not wrong}


def present_commit() -> str:
    """Of the checkout that this file lies in, with a + where it is changed; empty where it is no checkout."""
    return (_git("rev-parse", "--short=12", "HEAD") + "+" * bool(_git("status", "--porcelain", "--untracked-files=no")))


def _git(*words: str) -> str:
    try:
        return subprocess.run(["git", *words], cwd=HERE, text=True, capture_output=True, check=False).stdout.strip()
    except OSError:
        return ""
