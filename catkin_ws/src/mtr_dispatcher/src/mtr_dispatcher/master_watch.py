"""Polls the ROS master in a thread for the Operator's notices of other programs. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from typing import Any, Callable, Dict, Optional

from mtr_core import names

from .preflight_report import PreflightReport, report_in, with_motion

# A failed node is restarted after 2 s.
ASK_PERIOD_WALL_S = 1.0
# Most reported nodes at once; a broken installation has one cause.
MAX_TOLD = 4


def failures_in(parameter: Any) -> Dict[str, str]:
    """Return sentences by node, the first few by name, from the master's parameter, which any program may have set."""
    known = parameter if isinstance(parameter, dict) else {}
    return {str(node): str(known[node]) for node in sorted(known, key=str)[:MAX_TOLD]}


class MasterWatch:
    """Polls from its own thread, because a busy master answers late.

    Attributes:
        failures: why nodes cannot start, by their names, from the newest answer.
        preflight: findings of the last preflight, or None before the first.
    """

    def __init__(self, ask: Callable[[str], Any]):
        """ask: returns the value of a parameter, or None without one; an exception counts as no answer."""
        self.failures: Dict[str, str] = {}
        self.preflight: Optional[PreflightReport] = None
        self._ask = ask

    def start(self) -> None:
        """Start to poll."""
        threading.Thread(target=self._run, name="master watch", daemon=True).start()

    def update(self) -> None:
        """Poll once; without an answer the previous values remain."""
        try:
            self.failures = failures_in(self._ask(names.START_FAILURES))
            motion = report_in(self._ask(names.PREFLIGHT_MOTION))
            self.preflight = with_motion(report_in(self._ask(names.PREFLIGHT_REPORT)), motion)
        except Exception:  # Sockets, HTTP, XML and the master raise various errors; the thread must survive them.
            return

    def _run(self) -> None:
        while True:
            self.update()
            time.sleep(ASK_PERIOD_WALL_S)
