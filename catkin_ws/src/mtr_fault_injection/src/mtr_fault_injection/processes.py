"""Faults of nodes: stops, slows down or kills their processes. No ROS except the master's API."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import http.client
import os
import signal
import threading
import xmlrpc.client
from typing import Any, Callable, Iterable

from .parts import FaultError, Kind

CALLER = "/fault_injection"
# Period of a slow node, and share of it in which the node works.
SLOW_PERIOD_S, SLOW_SHARE = 0.1, 0.2
# Period in which a node that was killed and restarted is killed again.
KILL_PERIOD_S = 0.1
_UNREACHABLE = (OSError, xmlrpc.client.Error, http.client.HTTPException)


def process_of(master_uri: str, node: str) -> int:
    """Return the id of a node's process on this computer.

    Raises:
        FaultError: the node is not running.
    """
    master: Any = xmlrpc.client.ServerProxy(master_uri)
    try:
        code, problem, uri = master.lookupNode(CALLER, f"/{node.lstrip('/')}")
        if code != 1:
            raise FaultError(f"The node {node} does not run: {problem}.")
        api: Any = xmlrpc.client.ServerProxy(uri)
        return int(api.getPid(CALLER)[2])
    except _UNREACHABLE as error:
        raise FaultError(f"The node {node} does not answer: {error}.") from None


class ProcessFault:
    """Signals processes until `end`. find: returns the current processes."""

    def __init__(self, kind: Kind, find: Callable[[], Iterable[int]]):
        self._find, self._over = find, threading.Event()
        self._processes = list(find())
        work = {Kind.STOP: self._stop, Kind.SLOW: self._slow, Kind.KILL: self._kill}[kind]
        if kind is Kind.STOP:
            self._signal(signal.SIGSTOP)
        self._thread = threading.Thread(target=work, name="process fault", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Let the processes continue, and wait for the thread's end."""
        self._over.set()
        self._thread.join()

    def _stop(self) -> None:
        try:
            self._over.wait()
        finally:
            self._signal(signal.SIGCONT)

    def _slow(self) -> None:
        try:
            while not self._over.is_set():
                self._signal(signal.SIGSTOP)
                self._over.wait((1.0 - SLOW_SHARE) * SLOW_PERIOD_S)
                self._signal(signal.SIGCONT)
                self._over.wait(SLOW_SHARE * SLOW_PERIOD_S)
        finally:
            self._signal(signal.SIGCONT)

    def _kill(self) -> None:
        while True:
            self._signal(signal.SIGKILL)
            if self._over.wait(KILL_PERIOD_S):
                return
            # The master keeps a dead node until another one uses its name.
            with contextlib.suppress(FaultError):
                self._processes = list(self._find())

    def _signal(self, number: int) -> None:
        for process in self._processes:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, number)
