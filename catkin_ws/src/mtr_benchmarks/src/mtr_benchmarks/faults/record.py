"""Stores the result of each cell as soon as it is done, so that an interrupted or split run loses nothing.

A line of the file is one cell: name, seed, commit of the checkout (`+`: modified), time, load of the machine, and
differences from the matrix.
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
    """One run of cells. folder: folder of the stored results."""

    folder: pathlib.Path
    seed: int
    commit: str

    def keep(self, cell: str, wrong: List[str]) -> None:
        """Append the result of a cell."""
        now = datetime.now(timezone.utc).isoformat(timespec="seconds")
        line = {"cell": cell, "seed": self.seed, "commit": self.commit, "time": now,
                "load": round(os.getloadavg()[0], 1), "wrong": wrong}
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / FILE).open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")


def right_of(folder: pathlib.Path, commit: str) -> Set[str]:
    """Return the cells whose latest result on a commit has no differences."""
    path = folder / FILE
    lines: List[Dict[str, Any]] = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()
                                   ] if path.exists() else []
    newest = {line["cell"]: line["wrong"] for line in lines if line["commit"] == commit}
    return {cell for cell, wrong in newest.items() if not wrong}


def present_commit() -> str:
    """Return the commit of this checkout, with a + if it is modified; empty outside a checkout."""
    return (_git("rev-parse", "--short=12", "HEAD") + "+" * bool(_git("status", "--porcelain", "--untracked-files=no")))


def _git(*words: str) -> str:
    try:
        return subprocess.run(["git", *words], cwd=HERE, text=True, capture_output=True, check=False).stdout.strip()
    except OSError:
        return ""
