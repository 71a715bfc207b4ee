"""The folder of a campaign: one folder for each run, which appears whole or not at all."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import os
import pathlib
import shutil
import uuid
from dataclasses import dataclass
from typing import Any, Iterator

from ..errors import CampaignError
from ..plan.run import Run

RUNS, RUN_FILE, LOG_FILE = "runs", "run.json", "log.txt"
OK, FAILED = "ok", "failed"
_BEGUN = ".begun-"


@dataclass(frozen=True)
class Done:
    """One run that has come to its end. status: OK or FAILED; reason: a sentence of a failed one. seconds: of wall
    time. outcome: as Outcome.to_document()."""

    digest: str
    run: Run
    status: str
    reason: str
    seconds: float
    outcome: dict[str, Any]

    def to_document(self) -> dict[str, Any]:
        """Plain values."""
        return {"digest": self.digest, **self.run.to_document(), "status": self.status, "reason": self.reason,
                "seconds": round(self.seconds, 3), **self.outcome}


class CampaignFolder:
    """Where a campaign's runs lie. Any number of workers may write at once."""

    def __init__(self, path: pathlib.Path):
        self.path = path

    def make(self) -> None:
        """CampaignError when it cannot be made."""
        try:
            (self.path / RUNS).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CampaignError(f"The folder {self.path} cannot be made: {error.strerror or error}.") from None

    def of_run(self, digest: str) -> pathlib.Path:
        """Of a run that is done."""
        return self.path / RUNS / digest

    def done(self, digest: str) -> Done | None:
        """A run that has come to its end; None while it has not."""
        try:
            document = json.loads((self.of_run(digest) / RUN_FILE).read_text(encoding="utf-8"))
            return Done(digest, Run(document["kernel"], document["scenario"], document["settings"]),
                        document["status"], document["reason"], document["seconds"],
                        {name: document[name] for name in ("figures", "distances")})
        except (OSError, ValueError, LookupError, TypeError):
            return None

    @contextlib.contextmanager
    def begun(self, digest: str) -> Iterator[pathlib.Path]:
        """A folder of its own for a run, which becomes that of the run at the end; of two that run the same at once,
        as after a worker that was thought to be dead, the first one stays."""
        place = self.path / RUNS / f"{_BEGUN}{digest}-{uuid.uuid4().hex[:8]}"
        place.mkdir()
        try:
            yield place
            known, target = self.done(digest), self.of_run(digest)
            if known is not None and known.status == OK:
                return
            if target.exists():
                shutil.rmtree(target)
            with contextlib.suppress(OSError):
                os.rename(place, target)
        finally:
            shutil.rmtree(place, ignore_errors=True)

    def forget_begun(self) -> int:
        """Remove what killed workers have left; how many there were. Nobody may be running meanwhile."""
        left = list((self.path / RUNS).glob(f"{_BEGUN}*"))
        for place in left:
            shutil.rmtree(place, ignore_errors=True)
        return len(left)
