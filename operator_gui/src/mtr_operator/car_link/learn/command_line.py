"""Command that learns a new Car's profile: it prompts a person to lock and unlock the Car, and records its bus."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib
import sys
import time
from typing import Callable, Iterator, Sequence, TextIO

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import LockState
from mtr_operator.terminal import show, show_error

from ..adapter import AdapterSettings
from .database_names import DatabaseNames
from .findings import Findings
from .learning import Learning, Listen
from .listener import Listener
from .session import REST_S, Stage
from .words import HEADINGS, cells, doubts, unnamed
from .written_profile import check_name, message_name, write_profile

_POLL_S = 0.05
_GAP = "  "
_QUESTIONS = {LockState.LOCKED: "lock the Car with its own key", LockState.UNLOCKED: "unlock the Car, all doors"}


def learn(options: argparse.Namespace) -> None:
    """Learn on the adapter that the options name, and write the profile."""
    settings = AdapterSettings(options.can_interface, options.can_channel, options.can_bitrate,
                               is_listening=not options.can_normal, data_bitrate_bps=options.can_data_bitrate)
    learn_by(lambda heard: Listener(settings, heard), options)


def learn_by(listen: Listen, options: argparse.Namespace, stdin: TextIO | None = None,
             clock: Callable[[], float] = time.monotonic, wait: Callable[[float], None] = time.sleep) -> None:
    """Learn, print the findings and write the profile; stdin, clock, wait: of the process by default."""
    names = DatabaseNames(options.database) if options.database else None
    check_name(options.out, has_database=names is not None)
    learning = Learning(listen, options.prompts, clock)
    with contextlib.closing(learning):
        _listen(learning, stdin or sys.stdin, wait)
    findings = learning.findings()
    for line in _table(findings, names):
        show(line)
    for doubt in (*doubts(findings), unnamed(findings, names)):
        if doubt:
            _say(doubt)
    write_profile(options.out, findings, names)
    best = findings.proposal
    named = None if names is None else names.named(best)
    name = message_name(best) if named is None else named.message
    print(f"Message {name} tells the locks; the profile is in {options.out}. Try it: --car-profile "
          f"{options.out}")


def _listen(learning: Learning, stdin: TextIO, wait: Callable[[float], None]) -> None:
    """Prompt until the recording is complete; Enter answers a prompt."""
    session, before = learning.session, Stage.OPENING
    learning.start()
    while (stage := learning.tick()) is not Stage.COMPLETE:
        if stage is Stage.REST and before is not stage:
            _say(f"Listening for {REST_S:.0f} s; leave the Car alone.")
        if before is Stage.REST and stage is Stage.ASKED:
            _say(f"{session.recording.count / REST_S:.0f} frames a second.")
        before = stage
        if stage is not Stage.ASKED:
            wait(_POLL_S)
            continue
        _say(f"{session.number}/{session.prompts}: {_QUESTIONS[session.wanted]}, then press Enter and leave it alone.")
        if not stdin.readline():
            raise InvalidParameter("The input has ended before all prompts were answered; learn needs a terminal.")
        learning.done()


def _say(sentence: str) -> None:
    show_error(sentence)


def _table(findings: Findings, names: DatabaseNames | None) -> Iterator[str]:
    rows: list[Sequence[str]] = [HEADINGS, *(cells(each, findings.stays, names) for each in findings.candidates)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADINGS))]
    for row in rows:
        yield _GAP.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
