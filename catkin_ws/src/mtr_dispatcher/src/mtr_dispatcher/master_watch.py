"""What other programs left with the ROS master for the Operator, asked beside everything else. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from typing import Any, Callable, Dict, Optional

from mtr_core import names

from .preflight_report import PreflightReport, report_in, with_motion

# A node is started again after 2 s.
ASK_PERIOD_WALL_S = 1.0
# So many are told at once; a broken installation has one cause.
MAX_TOLD = 4


def failures_in(parameter: Any) -> Dict[str, str]:
    """Sentences by node, the first few by name, of what the master has; it holds what anybody has set."""
    known = parameter if isinstance(parameter, dict) else {}
    return {str(node): str(known[node]) for node in sorted(known, key=str)[:MAX_TOLD]}


class MasterWatch:
    """Asks from a thread of its own: a call to a busy master takes its time.

    Attributes:
        failures: why nodes cannot start, by their names; the newest answer.
        preflight: what the last preflight found, None before one was made.
    """

    def __init__(self, ask: Callable[[str], Any]):
        """ask: the value of a parameter, None when there is none; whatever it raises is no answer."""
        self.failures: Dict[str, str] = {}
        self.preflight: Optional[PreflightReport] = None
        self._ask = ask

    def start(self) -> None:
        """Begin to ask."""
        threading.Thread(target=self._run, name="master watch", daemon=True).start()

    def update(self) -> None:
        """Ask once; without an answer what was known before stands."""
        try:
            self.failures = failures_in(self._ask(names.START_FAILURES))
            motion = report_in(self._ask(names.PREFLIGHT_MOTION))
            self.preflight = with_motion(report_in(self._ask(names.PREFLIGHT_REPORT)), motion)
        except Exception:  # Of sockets, HTTP, XML, the master: a thread that ended would tell nothing any more.
            return

    def _run(self) -> None:
        while True:
            self.update()
            time.sleep(ASK_PERIOD_WALL_S)
