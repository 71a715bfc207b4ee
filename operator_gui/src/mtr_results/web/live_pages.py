"""Pages of tests in progress, and the event streams that update them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import asyncio
import json
from typing import AsyncIterator, Mapping

from starlette.concurrency import run_in_threadpool

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.scenarios import SCENARIOS

from ..live.followed import FollowedTest, look
from ..live.sections import DISTANCES, NOW, PICTURE, POINTS
from ..live.watch import Watch
from ..report.pages import render, template_text

# The application records its status once per second.
PERIOD_S = 0.5
# Proxies between browser and server close a connection after a minute without data.
_STILL_HERE_S = 15.0
# More browsers than a laboratory has; each stream checks some files twice per second.
MAX_STREAMS = 32
_MAX_LISTED = 20


class LivePages:
    """Read-only pages."""

    def __init__(self, watch: Watch):
        self._watch = watch
        self._streams = 0

    def list(self) -> str:
        """Return the list of the most recently written tests."""
        rows = [self._row(test) for test in self._watch.tests()[:_MAX_LISTED]]
        return render("live_list.html", "Tests being measured", True, tests=rows,
                      is_following=self._watch.is_following)

    def page(self, name: str) -> str:
        """Return the page of one test in its present state; StoreError if there is none."""
        test = self._watch.test(name)
        parts = {**dict.fromkeys((NOW, PICTURE, DISTANCES, POINTS), ""), **self._watch.sections(test)}
        return render("live.html", self._row(test)["title"], True, name=name, parts=parts)

    @staticmethod
    def script() -> str:
        """Return the script that applies the events in the browser."""
        return template_text("live.js")

    async def events(self, name: str) -> AsyncIterator[str]:
        """Yield all sections, then each changed one, at the rate of the browser and without a queue."""
        self._streams += 1
        try:
            test = await run_in_threadpool(self._watch.test, name)
            sent: Mapping[str, str] = {}
            quiet_s = 0.0
            while True:
                now = await run_in_threadpool(self._watch.sections, test)
                changed = {part: html for part, html in now.items() if sent.get(part) != html}
                quiet_s = 0.0 if changed else quiet_s + PERIOD_S
                if changed:
                    yield f"data: {json.dumps(changed)}\n\n"
                elif quiet_s >= _STILL_HERE_S:
                    quiet_s = 0.0
                    yield ": still here\n\n"
                sent = {**sent, **now}
                await asyncio.sleep(PERIOD_S)
        finally:
            self._streams -= 1

    @property
    def is_full(self) -> bool:
        """True if no further browser can subscribe to events."""
        return self._streams >= MAX_STREAMS

    def test(self, name: str) -> FollowedTest:
        """Return a followed test; StoreError if there is none."""
        return self._watch.test(name)

    def _row(self, test: FollowedTest) -> dict[str, str]:
        """Return the row of a test in the list; an unreadable test has its error as state."""
        try:
            entry = self._watch.so_far(test).entry
        except OperatorError as error:
            return {"name": test.name, "title": test.path.stem, "started": "", "lines": "", "state": str(error)}
        seen = look(test.path)
        state = "is being measured" if seen.is_measured else "silent" if seen.is_held else "ended"
        return {"name": test.name, "title": f"{SCENARIOS[entry.scenario].title}, {test.path.parent.name}",
                "started": entry.started.replace("T", " ")[:16], "lines": f"{entry.done}/{entry.total or '?'}",
                "state": state}
