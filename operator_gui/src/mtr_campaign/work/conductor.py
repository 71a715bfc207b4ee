"""Execution of a plan; finished runs are not repeated."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Callable, Iterable, Sequence

from ..plan.plan import OPTIMISE, Plan
from ..plan.run import Run
from .crew import Crew
from .folder import FAILED, OK, CampaignFolder, Done
from .junit import junit_xml
from .optimiser import Optimiser

_NO_RESULT = "The run left no result; the workers of a scheduler have to see the campaign's folder under the same path."
SUMMARY, JUNIT = "campaign.json", "junit.xml"


@dataclass
class Course:
    """Progress of a campaign. told: callback for each finished run, with True if it was done before."""

    told: Callable[[Done, bool], None] = lambda done, was_done: None
    runs: dict[str, Done] = field(default_factory=dict)
    known: int = 0

    def take(self, done: Done, was_done: bool) -> None:
        """Add a run; equal runs of a plan count once."""
        if done.digest not in self.runs:
            self.runs[done.digest] = done
            self.known += was_done
            self.told(done, was_done)

    @property
    def failed(self) -> list[Done]:
        """Runs without a result."""
        return [done for done in self.runs.values() if done.status == FAILED]


class Conductor:
    """Executes a plan with a crew of workers."""

    def __init__(self, plan: Plan, folder: CampaignFolder, crew: Crew):
        self._plan = plan
        self._folder = folder
        self._crew = crew

    def run(self, course: Course, batch: int = 1) -> None:
        """Run the plan, then write its files. batch: number of runs of an optimisation that are requested together."""
        if self._plan.design.kind == OPTIMISE:
            self._optimise(course, batch)
        else:
            self._work(list(self._plan.runs()), course)
        self._write(course)

    def _work(self, runs: Sequence[Run], course: Course) -> list[Done]:
        by_digest = {run.digest: run for run in runs}
        missing = []
        for digest, run in by_digest.items():
            done = self._folder.done(digest)
            if done is not None and done.status == OK:
                course.take(done, True)
            else:
                missing.append(run)
        self._crew.work(missing, str(self._folder.path), lambda digest, lost: course.take(
            self._ended(by_digest[digest], lost), False))
        return [course.runs[run.digest] for run in runs]

    def _ended(self, run: Run, lost: str) -> Done:
        done = None if lost else self._folder.done(run.digest)
        return done or Done(run.digest, run, FAILED, lost or _NO_RESULT, 0.0,
                            {"figures": {}, "distances": {}})

    def _optimise(self, course: Course, batch: int) -> None:
        """Run the optimisation in batches.

        Each batch depends on the results of previous ones, in the order of the requests. The same plan therefore
        requests the same runs, and an interrupted campaign finds its finished runs.
        """
        optimiser, left = Optimiser(self._plan), self._plan.design.runs
        while left > 0:
            asked = optimiser.ask(min(batch, left))
            done = self._work([self._plan.run(settings) for settings in asked], course)
            optimiser.tell(done)
            left -= len(asked)

    def _write(self, course: Course) -> None:
        documents = [done.to_document() for done in course.runs.values()]
        summary = {"campaign": self._plan.name, "kernel": self._plan.kernel, "scenario": self._plan.scenario,
                   "runs": len(documents), "failed": len(course.failed), "table": documents}
        (self._folder.path / SUMMARY).write_text(json.dumps(summary, indent=1, allow_nan=False), encoding="utf-8")
        (self._folder.path / JUNIT).write_text(junit_xml(self._plan.name, _sorted(course.runs.values())),
                                               encoding="utf-8")


def _sorted(runs: Iterable[Done]) -> list[Done]:
    return sorted(runs, key=lambda done: done.digest)
