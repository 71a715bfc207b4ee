"""Runs all proofs of robustness against attacks and faults in two lanes; faults.json has their common table.

Usage, from the top of the checkout: python -m mtr_benchmarks.faults.proofs --out out/bench [--only matrix soak ...]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import pathlib
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple

_COMMAND_FUZZ = "catkin_ws/src/mtr_dispatcher/tests/unit/command_fuzz.py"
FILE = "faults.json"


@dataclass(frozen=True)
class Proof:
    """One program. file: its figures and table; command: arguments of `python`, without --seed and --out."""

    name: str
    file: str
    command: Tuple[str, ...]
    takes_seed: bool = True


# Two programs run at a time; the longest is first in each lane.
LANES = (
    (Proof("matrix", "faults.json", ("-m", "mtr_benchmarks.faults")),),
    (Proof("soak", "soak.json", ("-m", "mtr_benchmarks.soak", "--hours", "1")),
     Proof("fuzz", "fuzz.json", ("tests/fuzz/run.py", "--cases", "100000")),
     Proof("fuzz of Commands", "fuzz_commands.json", (_COMMAND_FUZZ,)),
     Proof("kills", "kills.json", ("operator_gui/tests/proofs/kills.py", "--kills", "100")),
     Proof("kills of nodes", "node_kills.json", ("-m", "mtr_benchmarks.kills", "--kills", "10")),
     Proof("link", "link.json", ("-m", "mtr_benchmarks.link"), False)),
)


@dataclass(frozen=True)
class Ran:
    """Result of one program. document: content of its file; None: the program wrote none."""

    proof: Proof
    status: int
    took_s: float
    document: Optional[Dict[str, Any]]


def main(arguments: Optional[List[str]] = None) -> int:
    """Run the programs; return 0 if every row meets its requirement."""
    names = [proof.name for lane in LANES for proof in lane]
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--only", nargs="*", default=names, choices=names, help="default: all")
    options = parser.parse_args(arguments)
    parts = options.out / "proofs"
    parts.mkdir(parents=True, exist_ok=True)
    lanes = [[proof for proof in lane if proof.name in options.only] for lane in LANES]
    with ThreadPoolExecutor(len(lanes)) as pool:
        ran = [each for lane in pool.map(lambda lane: [run(proof, parts, options.seed) for proof in lane], lanes)
               for each in lane]
    document = together(ran)
    (options.out / FILE).write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print("\n".join(f"{row['name']}: {row['value']} {row['unit']}{'' if row['met'] else '  NOT MET'}"
                    for row in document["table"]))
    return 0 if all(row["met"] for row in document["table"]) else 1


def run(proof: Proof, folder: pathlib.Path, seed: int) -> Ran:
    """Run one program in its own process; its output goes to a log next to its figures."""
    path, begun_s = folder / proof.file, time.monotonic()
    path.unlink(missing_ok=True)
    seeded = ("--seed", str(seed)) if proof.takes_seed else ()
    # The programs end with this one, and end their robots.
    command = ["setpriv", "--pdeathsig", "TERM", sys.executable, *proof.command, *seeded, "--out", str(folder)]
    with path.with_suffix(".log").open("wb") as log:
        status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
    took_s = time.monotonic() - begun_s
    print(f"{proof.name}: ended with status {status} after {took_s / 60.0:.0f} min", flush=True)
    return Ran(proof, status, took_s, json.loads(path.read_text(encoding="utf-8")) if path.exists() else None)


def together(ran: List[Ran]) -> Dict[str, Any]:
    """Return the figures by proof and one table; a proof without a table is a row that is not met."""
    rows: List[Dict[str, Any]] = []
    for each in ran:
        table = (each.document or {}).get("table", [])
        rows += [{**row, "name": f"{each.proof.name}: {row['name']}", "met": bool(row.get("met", row.get("is_met")))}
                 for row in table]
        is_whole = bool(table) and each.status in (0, 1)
        rows.append({"name": f"{each.proof.name}: came to its end", "unit": "(share)", "value": float(is_whole),
                     "must": 1.0, "met": is_whole})
    figures = {each.proof.name: {"took_s": each.took_s, **(each.document or {})} for each in ran}
    return {"proofs": figures, "table": rows}


if __name__ == "__main__":
    sys.exit(main())
