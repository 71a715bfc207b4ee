"""kill -9 at random instants of whole tests, each gone on with after the kill: is anything lost, doubled or changed?

Usage: kills.py [--kills N] [--seed N] [--out FOLDER]

Both scenarios, on the robot and the Car inside the application. A point counts as lost when the robot was ordered on
after it was measured and the journal does not have it; a line, when it was shown and is not there after the next start.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import csv
import json
import os
import pathlib
import random
import signal
import sys
import tempfile
import time

import table
import witness

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.journal.journal_file import journal_path, read_journal
from mtr_operator.storage.progress_file import FILE_NAME, load_progress

PARAMETERS = {"autolock": {"measurements_distance_m": 0.2, "minimum_distance_m": 0.5},
              "key_press": {"angle_between_radials_deg": 3.0}}
MUST = ("lines lost", "points lost that the robot was ordered on after", "lines shown and not kept", "lines doubled",
        "points doubled", "good lines changed", "entries of the journal changed", "files that cannot be read",
        "lines missing at the end", "distances that are no point of the journal", "starts that failed")
# A run lives for as long as it takes, in time of the processor, from its start to so many lines, of which the first of
# them is measured on this machine. Whatever else it does, the kills fall on all parts of a run.
LINES_OF_LONGEST_LIFE = 10
# Some live until they write reports, which takes the processor longer than all lines.
SHARE_OF_LATE, LATEST_S = 0.1, 0.8
# Of all kills; fewer with a line at hand and the proof has tried starts alone.
MIN_SHARE_INSIDE = 0.1
TOO_FEW_INSIDE = "scenarios of which fewer than a tenth of the kills had a line at hand"
CLOCK_TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")


class Chain:
    """One test, killed again and again, until enough are killed; then it comes to its end.

    Attributes:
        kills, inside: all, and those with a line at hand. found: what must not be, by name of MUST.
    """

    def __init__(self, scenario, folder, chance, longest_life_s):
        self.scenario, self.folder, self.chance = SCENARIOS[scenario], folder, chance
        self.longest_life_s = longest_life_s
        self.path = folder / "out" / FILE_NAME
        self.notes, self.said = folder / "notes", folder / "said"
        self.parameters = self.scenario.parameters_type.from_mapping(PARAMETERS[scenario])
        (folder / "parameters.json").write_text(json.dumps(PARAMETERS[scenario]), encoding="utf-8")
        self.kills = self.inside = self.starts = 0
        self.found = collections.Counter()
        self.good, self.kept = {}, b""

    def run(self, wanted):
        """Kill it so many times at most, then let it end."""
        while self.kills < wanted:
            if not self._live(self._life_s()):
                break
            self.kills += 1
            self._check()
        else:
            self._live(None)
        self._check()
        self._check_end()

    def _life_s(self):
        is_late = self.chance.random() < SHARE_OF_LATE
        return self.chance.uniform(0.0, LATEST_S if is_late else self.longest_life_s)

    def _live(self, life_s):
        """Start or go on; True when it was killed after life_s, False when it came to its end."""
        process = self.begin()
        if life_s is not None:
            used_s = wait_until(process, lambda used_s: used_s + CLOCK_TICK_S > life_s)
            # The rest is less than the clock shows.
            time.sleep(max(0.0, life_s - used_s))
            os.kill(process, signal.SIGKILL)
        _, status = os.waitpid(process, 0)
        if os.WIFSIGNALED(status):
            return True
        self.found["starts that failed"] += os.waitstatus_to_exitcode(status) != 0
        return False

    def begin(self):
        """Start or go on; the number of the process."""
        self.starts += 1
        # Another seed each time: else the substitutes repeat themselves, and so would what is measured.
        arguments = ["run", self.scenario.name, "--params", self.folder / "parameters.json", "--out",
                     self.folder / "out", "--simulated-robot", "--simulated-car", "--seed", self.starts]
        if self._has_findings():
            arguments += ["--continue", self.path]
        return witness.begin(arguments, self.said, self.notes)

    def _has_findings(self):
        journal = journal_path(self.path)
        return self.path.exists() or (journal.exists() and read_journal(journal).holds_findings)

    def _loaded(self):
        try:
            return load_progress(self.path, self.scenario, self.parameters.to_mapping())
        except ProgressFileError as error:
            self.found["files that cannot be read"] += 1
            print(error, file=sys.stderr)
            return None

    def _check(self):
        """What is on disk against what was there before and what the witness has noted."""
        notes = witness.read_notes(self.notes)
        entries = read_journal(journal_path(self.path)).entries if journal_path(self.path).exists() else ()
        points = collections.Counter(
            json.dumps([entry.values[name] for name in ("word", "status", "distance")])
            for entry in entries if entry.kind == "point")
        lines = [entry.values["result"] for entry in entries if entry.kind == "line"]
        for what, value in notes:
            if what == witness.ORDERED:
                self.found["points lost that the robot was ordered on after"] += json.dumps(value) not in points
            elif what == witness.SHOWN:
                self.found["lines shown and not kept"] += value not in lines
        measured = collections.Counter(json.dumps(value) for what, value in notes if what == witness.MEASURED)
        self.found["points doubled"] += sum((points - measured).values())
        self._check_journal()
        if self._has_findings():
            self._check_progress()

    def _check_journal(self):
        """Appended to, and nothing else; what a kill has cut off was no entry."""
        path = journal_path(self.path)
        content = read_journal(path).content if path.exists() else b""
        self.found["entries of the journal changed"] += not content.startswith(self.kept)
        # Before the first finding a test begins anew.
        self.kept = content if self._has_findings() else b""

    def _check_progress(self):
        progress = self._loaded()
        if progress is None:
            return
        self.inside += progress.line_at_hand is not None
        numbers = progress.measured()
        self.found["lines doubled"] += len(numbers) - len(set(numbers))
        results = {result.number: result for result in progress.results}
        for number, result in self.good.items():
            self.found["lines lost"] += number not in results
            self.found["good lines changed"] += number in results and results[number] != result
        self.good = {number: result for number, result in results.items() if not result.invalid_count}

    def _check_end(self):
        progress = self._loaded()
        if progress is None:
            return
        wanted = {line.number for line in self.scenario.lines(self.parameters, progress.measured_car)}
        with open(self.folder / "out" / "results.csv", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        reported = [int(row[0]) for row in rows[1:]]
        self.found["lines missing at the end"] += len(wanted - set(reported))
        self.found["lines doubled"] += len(reported) - len(set(reported))
        points = {round(entry.values["distance"]["distance_m"], 6)
                  for entry in read_journal(journal_path(self.path)).entries
                  if entry.kind == "point" and entry.values["distance"]}
        for result in progress.results:
            self.found["distances that are no point of the journal"] += sum(
                distance.distance_m is not None and distance.distance_m not in points for distance in result.distances)


def wait_until(process, condition):
    """Wait until a condition holds of the time for which a process has used the processor, or it has ended; that, s."""
    while True:
        fields = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
        used_s = (int(fields[11]) + int(fields[12])) * CLOCK_TICK_S
        if fields[0] == "Z" or condition(used_s):
            return used_s
        time.sleep(CLOCK_TICK_S / 4.0)


def longest_life_s(scenario, folder):
    """Of a run that nobody kills before it has shown so many lines, s."""
    first = Chain(scenario, pathlib.Path(tempfile.mkdtemp(dir=folder)), random.Random(0), 0.0)
    process = first.begin()
    shown = f'["{witness.SHOWN}"'
    used_s = wait_until(process, lambda _: first.notes.exists() and first.notes.read_text(encoding="utf-8").count(
        shown) >= LINES_OF_LONGEST_LIFE)
    os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)
    return used_s


def prove(scenario, kills, seed, folder):
    """Chains until there are so many kills; their sum."""
    chance, total = random.Random(f"{seed} {scenario}"), collections.Counter()
    longest_s = longest_life_s(scenario, folder)
    total["longest life, ms"] = round(1000.0 * longest_s)
    while total["kills"] < kills:
        place = pathlib.Path(tempfile.mkdtemp(dir=folder))
        chain = Chain(scenario, place, chance, longest_s)
        chain.run(min(kills - total["kills"], chance.randint(20, 60)))
        total.update({"kills": chain.kills, "chains": 1, "with a line at hand": chain.inside, **chain.found})
        if sum(chain.found.values()):
            print(f"{place}: {dict(chain.found)}", file=sys.stderr)
    return total


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=1000, help="of each scenario, default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="of the instants, default %(default)s")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        totals = {name: prove(name, options.kills, options.seed, folder) for name in PARAMETERS}
    counts = {name: sum(total[name] for total in totals.values()) for name in MUST}
    counts[TOO_FEW_INSIDE] = sum(total["with a line at hand"] < MIN_SHARE_INSIDE * total["kills"]
                                 for total in totals.values())
    figures = {name: {key: total[key] for key in ("kills", "chains", "with a line at hand", "longest life, ms")}
               for name, total in totals.items()}
    return table.finish(options.out / "kills.json", figures, counts)


if __name__ == "__main__":
    sys.exit(main())
