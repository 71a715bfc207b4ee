"""The workers: processes of this computer, or whoever listens to a scheduler of Dask."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import itertools
import logging
from typing import Any, Callable, Iterator, Protocol, Sequence

from ..errors import CampaignError
from ..plan.run import Run
from .one_run import execute

CONNECT_S = 10.0
# A run whose worker died is run again by another one, so often.
_DEATHS = 3
# So many runs wait with the scheduler, so that a campaign of any size takes the same memory.
_WAITING_PER_WORKER = 64


class Crew(Protocol):
    """Runs what it is given; each outcome lies in the campaign's folder when its digest is told."""

    def work(self, runs: Sequence[Run], folder: str, told: Callable[[str, str], None]) -> None:
        """told: takes the digest of each run that has ended, and why it was lost, empty when it was not."""


class Here:
    """In this process, one after the other."""

    def work(self, runs: Sequence[Run], folder: str, told: Callable[[str, str], None]) -> None:
        """See Crew."""
        for run in runs:
            told(execute(run.to_document(), folder), "")


class DaskCrew:
    """Attributes: client: of dask.distributed."""

    def __init__(self, client: Any):
        self.client = client

    def work(self, runs: Sequence[Run], folder: str, told: Callable[[str, str], None]) -> None:
        """See Crew."""
        from distributed import as_completed
        waiting = iter(runs)
        # Workers may come and go.
        room = _WAITING_PER_WORKER * max(len(self.client.scheduler_info()["workers"]), 1)
        digests: dict[str, str] = {}
        first = [self._submit(run, folder, digests) for run in itertools.islice(waiting, room)]
        ahead = as_completed(first)
        for future in ahead:
            failed = future.status == "error"
            reason = f"The worker was lost: {type(future.exception()).__name__}" if failed else ""
            told(digests.pop(future.key), reason)
            future.release()
            for run in waiting:
                ahead.add(self._submit(run, folder, digests))
                break

    def _submit(self, run: Run, folder: str, digests: dict[str, str]) -> Any:
        digest = run.digest
        key = f"run-{digest}"
        digests[key] = digest
        return self.client.submit(execute, run.to_document(), folder, key=key, pure=False)


@contextlib.contextmanager
def crew_of(workers: int, scheduler: str = "") -> Iterator[Crew]:
    """The crew of so many processes here, none for this one alone, or of a scheduler; CampaignError when that does not
    answer."""
    if not scheduler and workers == 0:
        yield Here()
        return
    import dask
    from distributed import Client, LocalCluster
    with dask.config.set({"distributed.scheduler.allowed-failures": _DEATHS,
                          "distributed.comm.timeouts.connect": f"{CONNECT_S:g}s"}), contextlib.ExitStack() as stack:
        if not scheduler:
            cluster = stack.enter_context(LocalCluster(n_workers=workers, threads_per_worker=1, processes=True,
                                                       host="127.0.0.1", dashboard_address=None,
                                                       silence_logs=logging.CRITICAL))
            yield DaskCrew(stack.enter_context(Client(cluster)))
            return
        try:
            client = stack.enter_context(Client(scheduler, timeout=CONNECT_S))
        except (OSError, ValueError, TimeoutError) as error:
            raise CampaignError(f"The scheduler {scheduler} does not answer ({type(error).__name__}); start one with "
                                "dask scheduler, and workers with dask worker.") from None
        yield DaskCrew(client)
