"""Spoilt bytes at each border of the project: refused with a sentence or taken whole, within a second.

Usage: run.py [--cases N] [--seed N] [--out FOLDER] [--case N] [BORDER ...]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import importlib
import json
import logging
import pathlib
import subprocess
import sys
import tempfile
from typing import Any, Dict

from harness import MUST, Trial, bound_memory

# Cases of `make fuzz`; what needs sockets, curves or a database's parser takes longer.
BORDERS = {"progress_files": 10_000, "statuses": 100_000, "zeromq": 10_000, "pairing": 2_000, "slcan": 20_000,
           "rosserial": 10_000, "yaml_files": 10_000, "databases": 1_000, "other_databases": 1_000,
           "bus_logs": 10_000, "packed_logs": 5_000, "bundles": 2_000, "bags": 5_000}
CRASHES = "crashes"


def main() -> int:
    """Command line; 1 when something was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("borders", nargs="*", metavar="BORDER", help=f"default all: {', '.join(BORDERS)}")
    parser.add_argument("--cases", type=int, help="of each; default: as many as take a minute or less")
    parser.add_argument("--share", type=float, default=1.0, help="of that number, default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    parser.add_argument("--case", type=int, help="this one again, in this process, of one border")
    options = parser.parse_args()
    unknown = set(options.borders) - set(BORDERS)
    if unknown:
        parser.error(f"There is no border {min(unknown)}; there are: {', '.join(BORDERS)}.")
    names = options.borders or list(BORDERS)
    if options.case is not None:
        print(json.dumps(tried(names[0], range(options.case, options.case + 1), options.seed)))
        return 0
    found = {}
    for name in names:
        count = options.cases or max(int(BORDERS[name] * options.share), 1)
        found[name] = in_a_process(name, count, options.seed)
        print(f"{name}: {json.dumps(found[name])}", flush=True)
    return finish(options.out / "fuzz.json", found)


def tried(name: str, numbers: range, seed: int) -> Dict[str, Any]:
    """Figures of these cases of a border, in this process."""
    bound_memory()
    # What is logged of each refusal is no figure.
    logging.disable(logging.CRITICAL)
    trial = Trial(name, seed)
    with tempfile.TemporaryDirectory() as folder:
        case = importlib.import_module(f"borders.{name}").prepare(pathlib.Path(folder))
        for number in numbers:
            trial.run(case, number)
    return trial.figures()


def in_a_process(name: str, count: int, seed: int) -> Dict[str, Any]:
    """The same of so many cases, in a process of its own that may crash."""
    here = pathlib.Path(__file__).resolve().parent
    program = f"import json, run; print(json.dumps(run.tried({name!r}, range({count}), {seed})))"
    done = subprocess.run([sys.executable, "-c", program], cwd=here, text=True, stdout=subprocess.PIPE, check=False)
    if done.returncode:
        print(f"{name}: ended with status {done.returncode}\n{done.stdout}", file=sys.stderr)
        return {CRASHES: 1, "cases": 0}
    return {CRASHES: 0, **json.loads(done.stdout.splitlines()[-1])}


def finish(path: pathlib.Path, found: Dict[str, Dict[str, Any]]) -> int:
    """Write figures and the counts that must be 0; 1 when one is not."""
    rows = [{"name": f"{border}: {name}", "unit": "(count)", "value": figures.get(name, 0), "must": 0,
             "is_met": not figures.get(name, 0)} for border, figures in found.items() for name in (CRASHES, *MUST)]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**found, "table": rows}, indent=2) + "\n", encoding="utf-8")
    wrong = [f"{row['name']} {row['value']}, must 0: NOT MET" for row in rows if not row["is_met"]]
    print("\n".join(wrong or [f"Found nothing in {sum(each['cases'] for each in found.values())} cases."]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
