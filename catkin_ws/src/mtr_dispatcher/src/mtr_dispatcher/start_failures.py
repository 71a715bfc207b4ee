"""Why nodes cannot start, asked of the ROS master beside everything else. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from typing import Any, Callable, Dict

# A node is started again after 2 s.
ASK_PERIOD_WALL_S = 1.0
# So many are told at once; a broken installation has one cause.
MAX_TOLD = 4


def failures_in(parameter: Any) -> Dict[str, str]:
    """Sentences by node, the first few by name, of what the master has; it holds what anybody has set."""
    known = parameter if isinstance(parameter, dict) else {}
    return {str(node): str(known[node]) for node in sorted(known, key=str)[:MAX_TOLD]}


class StartFailures:
    """Asks from a thread of its own: a call to a busy master takes its time.

    Attributes:
        known: the newest answer.
    """

    def __init__(self, ask: Callable[[], Any]):
        """ask: what the master has; whatever it raises is no answer."""
        self.known: Dict[str, str] = {}
        self._ask = ask

    def start(self) -> None:
        """Begin to ask."""
        threading.Thread(target=self._run, name="start failures", daemon=True).start()

    def update(self) -> None:
        """Ask once; without an answer the one before stands."""
        try:
            self.known = failures_in(self._ask())
        except Exception:  # Of sockets, HTTP, XML, the master: a thread that ended would tell nothing any more.
            return

    def _run(self) -> None:
        while True:
            self.update()
            time.sleep(ASK_PERIOD_WALL_S)
