"""Short form of `make fuzz-commands`. N7, D5"""
# SPDX-License-Identifier: Apache-2.0
from command_fuzz import MUST, Fuzz


def test_no_mutated_command_raises_hangs_or_is_accepted_as_nonsense():
    fuzz = Fuzz(seed=2)
    fuzz.run(1000)
    assert [fuzz.counts[name] for name in MUST] == [0, 0, 0]
    assert min(fuzz.counts[name] for name in ("taken", "refused", "undecodable", "expired", "repeated")) > 0
