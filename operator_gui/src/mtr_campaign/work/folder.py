"""Folder of a campaign, with one subfolder per run, which is created atomically."""
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
    """One finished run. status: OK or FAILED; reason: sentence of a failed run.

    seconds: wall time. outcome: see Outcome.to_document().
    """

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
    """Folder with the runs of a campaign. Concurrent workers are safe."""

    def __init__(self, path: pathlib.Path):
        self.path = path

    def make(self) -> None:
        """Create the folder; CampaignError on failure."""
        try:
            (self.path / RUNS).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CampaignError(f"The folder {self.path} cannot be made: {error.strerror or error}.") from None

    def of_run(self, digest: str) -> pathlib.Path:
        """Return the folder of a finished run."""
        return self.path / RUNS / digest

    def done(self, digest: str) -> Done | None:
        """Return a finished run, or None."""
        try:
            document = json.loads((self.of_run(digest) / RUN_FILE).read_text(encoding="utf-8"))
            return Done(digest, Run(document["kernel"], document["scenario"], document["settings"]),
                        document["status"], document["reason"], document["seconds"],
                        {name: document[name] for name in ("figures", "distances")})
        except (OSError, ValueError, LookupError, TypeError):
            return None

    @contextlib.contextmanager
    def begun(self, digest: str) -> Iterator[pathlib.Path]:
        """Context with a temporary folder, which becomes the folder of the run at the end.

        If the same run is executed twice, as after a worker that was presumed dead, the first result remains.
        """
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
        """Remove remains of killed workers and return their number. No run may be active."""
        left = list((self.path / RUNS).glob(f"{_BEGUN}*"))
        for place in left:
            shutil.rmtree(place, ignore_errors=True)
        return len(left)
