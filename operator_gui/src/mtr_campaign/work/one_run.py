"""Task of a worker: one run, from its document to its folder."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import pathlib
import time
import traceback
from typing import Any, Mapping

from mtr_operator.domain.errors import OperatorError

from ..plan.run import Run, run_from
from .folder import FAILED, LOG_FILE, OK, RUN_FILE, CampaignFolder, Done

_NOTHING: dict[str, Any] = {"figures": {}, "distances": {}}


def execute(document: Mapping[str, Any], path: str) -> str:
    """Execute the run of a document unless it is done, and return its digest.

    Failures of the run are recorded, not raised.
    """
    run, folder = run_from(document), CampaignFolder(pathlib.Path(path))
    digest = run.digest
    known = folder.done(digest)
    if known is not None and known.status == OK:
        return digest
    with folder.begun(digest) as place:
        done = _attempt(run, digest, place)
        (place / RUN_FILE).write_text(json.dumps(done.to_document(), indent=1, allow_nan=False), encoding="utf-8")
    return digest


def _attempt(run: Run, digest: str, place: pathlib.Path) -> Done:
    from ..kernels.order import order_of
    from ..kernels.registry import kernel_of
    began_s = time.monotonic()
    try:
        outcome = kernel_of(run.kernel).run(order_of(run), place, digest)
        return Done(digest, run, OK, "", time.monotonic() - began_s, outcome.to_document())
    # A failed run must not stop the others, whatever the error.
    except Exception as error:
        with (place / LOG_FILE).open("a", encoding="utf-8") as log:
            log.write(traceback.format_exc())
        reason = str(error) if isinstance(error, OperatorError) else f"{type(error).__name__}: {error}"
        return Done(digest, run, FAILED, reason, time.monotonic() - began_s, _NOTHING)
