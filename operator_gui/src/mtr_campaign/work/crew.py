"""Workers: processes of this computer, or the workers of a Dask scheduler."""
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
# Number of worker deaths after which a run is given up; until then, another worker repeats it.
_DEATHS = 3
# Limit of the runs queued in the scheduler, so that the memory does not depend on the size of a campaign.
_WAITING_PER_WORKER = 64


class Crew(Protocol):
    """Workers; when the digest of a run is reported, its outcome is in the folder of the campaign."""

    def work(self, runs: Sequence[Run], folder: str, told: Callable[[str, str], None]) -> None:
        """Execute runs.

        told: callback with the digest of each finished run, and the reason if it was lost, otherwise empty.
        """


class Here:
    """Sequential execution in this process."""

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
        # The number of workers may change.
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
    """Context with a number of local worker processes (0: this process), or the workers of a scheduler.

    Raises CampaignError if the scheduler does not answer.
    """
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
