"""Short form of `make fuzz-commands`. N7, D5"""
# SPDX-License-Identifier: Apache-2.0
import json
from types import SimpleNamespace

import command_fuzz
from command_fuzz import MUST, Fuzz


def test_no_mutated_command_raises_hangs_or_is_accepted_as_nonsense():
    fuzz = Fuzz(seed=2)
    fuzz.run(1000)
    assert [fuzz.counts[name] for name in MUST] == [0, 0, 0]
    assert min(fuzz.counts[name] for name in ("taken", "refused", "undecodable", "expired", "repeated")) > 0


def test_figures_are_rows_as_those_of_other_proofs(monkeypatch, tmp_path):
    monkeypatch.setattr("sys.argv", ["command_fuzz.py", "--cases", "50", "--out", str(tmp_path)])
    # The memory bound would apply to the whole test process.
    monkeypatch.setattr(command_fuzz, "resource", SimpleNamespace(RLIMIT_AS=0, setrlimit=lambda *_: None))
    assert command_fuzz.main() == 0
    table = json.loads((tmp_path / "fuzz_commands.json").read_text(encoding="utf-8"))["table"]
    assert [(row["unit"], row["value"], row["is_met"]) for row in table] == 3 * [("(count)", 0, True)]
