"""Execution of a campaign for the command line: folder, workers, progress bar, store."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib
import pathlib
import sys
from dataclasses import dataclass
from typing import Iterator

from tqdm import tqdm

from mtr_operator.domain.errors import InUse
from mtr_operator.storage.inside import inside
from mtr_operator.storage.lock import Lock
from mtr_operator.terminal import show_error
from mtr_results.store.database import shown_address

from ..errors import CampaignError
from ..kernels.registry import check_plan
from ..plan.plan import Plan
from .conductor import Conductor, Course
from .crew import crew_of
from .folder import CampaignFolder, Done
from .keeping import Keeping

STORE_NAME = "results.sqlite"
_MAX_WORKERS = 1000


@dataclass(frozen=True)
class Finished:
    """A finished campaign."""

    plan: Plan
    course: Course
    folder: pathlib.Path
    store: str


def run_campaign(plan: Plan, options: argparse.Namespace) -> Finished:
    """Run everything that is not done. options: of the command line. CampaignError if the campaign cannot start."""
    if not 0 <= options.workers <= _MAX_WORKERS:
        raise CampaignError(f"--workers is {options.workers}; allowed are 0 to {_MAX_WORKERS}.")
    check_plan(plan)
    folder = CampaignFolder(inside(options.out, plan.name).resolve())
    folder.make()
    store = options.store or str(folder.path / STORE_NAME)
    keeping = Keeping(store, folder, plan.name)
    with _alone(folder), crew_of(options.workers, options.scheduler) as crew, tqdm(
            total=plan.size, desc=plan.name, unit="run", file=sys.stderr, disable=options.json or None) as bar:
        if not options.scheduler:
            folder.forget_begun()

        def told(done: Done, was_done: bool) -> None:
            keeping.take(done)
            bar.update()

        course = Course(told)
        Conductor(plan, folder, crew).run(course, max(options.workers, 1))
    for sentence in keeping.sentences[:3]:
        show_error(sentence)
    return Finished(plan, course, folder.path, shown_address(store))


@contextlib.contextmanager
def _alone(folder: CampaignFolder) -> Iterator[None]:
    """Context that excludes a second program with the same campaign; CampaignError if there is one."""
    try:
        with Lock(folder.path / "campaign"):
            yield
    except InUse:
        raise CampaignError(f"Another program runs the campaign in {folder.path}; wait for it, or choose another "
                            "--out.") from None
