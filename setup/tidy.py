"""Runs clang-tidy over the workspace's C++ as catkin compiles it; .clang-tidy says what it looks for.

Usage: tidy.py [--changed] [PATTERN of path...]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys
from typing import Dict, List

TOP = pathlib.Path(__file__).resolve().parent.parent
BUILD = TOP / "catkin_ws" / "build"
MERGED = TOP / "out" / "tidy"


def main(arguments: List[str]) -> int:
    """Check the wanted files two at a time; the exit status is 1 when one has a finding."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--changed", action="store_true", help="only files that differ from the last commit")
    parser.add_argument("patterns", nargs="*", help="only files whose path contains one of these")
    options = parser.parse_args(arguments)
    commands = compile_commands()
    wanted = options.patterns or [""]
    files = [name for name in sorted(commands) if any(pattern in name for pattern in wanted)]
    if options.changed:
        files = sorted(set(files) & set(changed()))
    MERGED.mkdir(parents=True, exist_ok=True)
    (MERGED / "compile_commands.json").write_text(json.dumps(list(commands.values())), encoding="utf-8")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        clean = list(pool.map(is_clean, files))
    print(f"clang-tidy: {clean.count(True)} files without a finding, {clean.count(False)} with one")
    return 0 if all(clean) else 1


def compile_commands() -> Dict[str, Dict[str, str]]:
    """File -> how it is compiled, from every package's build; only files of the project."""
    found = {}
    for path in BUILD.glob("*/compile_commands.json"):
        for entry in json.loads(path.read_text(encoding="utf-8")):
            if pathlib.Path(entry["file"]).is_file() and BUILD not in pathlib.Path(entry["file"]).parents:
                found[entry["file"]] = entry
    return found


def changed() -> List[str]:
    """Files of C++ that differ from the last commit, new ones too."""
    command = ["git", "status", "--porcelain", "--untracked-files=all", "--", "*.cpp"]
    lines = subprocess.run(command, cwd=TOP, text=True, capture_output=True, check=True).stdout.splitlines()
    return [str(TOP / line[3:].split(" -> ")[-1]) for line in lines]


def is_clean(name: str) -> bool:
    """Check one file; print what was found."""
    command = ["clang-tidy", "--quiet", "-p", str(MERGED), "--extra-arg=-Wno-unknown-warning-option", name]
    done = subprocess.run(command, cwd=TOP, text=True, capture_output=True, check=False)
    if done.returncode:
        print(done.stdout)
    return done.returncode == 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
