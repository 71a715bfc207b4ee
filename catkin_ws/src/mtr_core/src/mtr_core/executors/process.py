"""Executes long work in its own process, so that a node loses neither the interpreter's lock nor processor time.

A thread of the node would hold the interpreter's lock while the scheduler runs other threads, and the node's ticks
would wait for the lock.
"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import subprocess
import sys
import threading
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from multiprocessing import Pipe
from queue import SimpleQueue
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple, TypeVar

from .inline import InlineExecutor

WORKER = f"{__package__}.worker"
GONE = (EOFError, ConnectionError)
# The longest work, a Car in all returns of a drive around it, lasted 5 s of wall time next to 16 processes on two
# cores.
PATIENCE_S = 60.0
# Limit for the import of the work's modules, which needs processor time and reads from the disk.
START_PATIENCE_S = 60.0

Value = TypeVar("Value")


class ProcessExecutor(Executor):
    """Executes the work before it returns, one piece at a time; function, arguments and result are pickled.

    The process starts at once and ends with the owner's process, however that ends. If the process is dead (for example
    killed for its memory) or suspended, the work is executed here and the process is replaced.
    """

    def __init__(self, modules: List[str], tell: Callable[[str], None], patience_s: float = PATIENCE_S):
        """modules: names of the modules that the process imports at its start. tell: called with a text when the
        process is replaced. patience_s: limit in s for one piece of work, without the start of the process."""
        self._modules, self._tell, self._patience_s = modules, tell, patience_s
        self._lock = threading.Lock()
        self._inline = InlineExecutor()
        self._is_ready = False
        self._start()

    @property
    def process_id(self) -> int:
        """Id of the worker process."""
        return self._process.pid

    def submit(self, fn: Callable[..., Value], *args: Any, **kwargs: Any) -> "Future[Value]":
        """Return the completed work's result."""
        with self._lock:
            try:
                self._wait_until_ready()
                value, error = self._answer((fn, args, kwargs))
            except GONE:
                self._replace()
                return self._inline.submit(fn, *args, **kwargs)
        done: Future[Value] = Future()
        if error is not None:
            done.set_exception(error)
        else:
            done.set_result(value)
        return done

    def shutdown(self, wait: bool = True, **_: Any) -> None:
        """End the process."""
        self._connection.close()
        if wait:
            self._process.wait()

    def _wait_until_ready(self) -> None:
        """Wait until the process has imported its modules; raises an error of GONE if it is dead or too slow."""
        if not self._is_ready:
            with self._killed_after(START_PATIENCE_S):
                self._connection.recv()
            self._is_ready = True

    def _answer(self, work: Tuple[Any, ...]) -> Tuple[Any, Optional[Exception]]:
        with self._killed_after(self._patience_s):
            self._connection.send(work)
            value, error = self._connection.recv()
        return value, error

    @contextlib.contextmanager
    def _killed_after(self, patience_s: float) -> Iterator[None]:
        """Kill the process if the enclosed work exceeds the limit; a suspended process does not even receive."""
        watchdog = threading.Timer(patience_s, self._process.kill)
        watchdog.daemon = True
        watchdog.start()
        try:
            yield
        finally:
            watchdog.cancel()

    def _start(self) -> None:
        self._connection, far = Pipe()
        with far:
            # A separate session shields it from Ctrl-C, and a scheduler with per-session shares gives it its own share.
            self._process = subprocess.Popen(
                [sys.executable, "-m", WORKER, str(far.fileno()), *self._modules], pass_fds=[far.fileno()],
                stdin=subprocess.DEVNULL, start_new_session=True)
        self._is_ready = False

    def _replace(self) -> None:
        self._connection.close()
        self._process.kill()
        status = self._process.wait()
        self._tell(f"The process {self._process.pid} for long work has ended, or has not answered for "
                   f"{self._patience_s:g} s (status {status}); this node does the work itself and starts another one.")
        self._start()


class ProcessesExecutor(Executor):
    """Executes several pieces of work at once, each in its own process, in parallel to the caller."""

    def __init__(self, count: int, modules: List[str], tell: Callable[[str], None]):
        """count: number of processes; the other arguments as for ProcessExecutor."""
        self._threads = ThreadPoolExecutor(count)
        self._processes = [ProcessExecutor(modules, tell) for _ in range(count)]
        self._idle: SimpleQueue[ProcessExecutor] = SimpleQueue()
        for process in self._processes:
            self._idle.put(process)

    def submit(self, fn: Callable[..., Value], *args: Any, **kwargs: Any) -> "Future[Value]":
        """Submit the work, which can be cancelled until a process is free for it."""
        return self._threads.submit(self._do, fn, args, kwargs)

    def shutdown(self, wait: bool = True, **_: Any) -> None:
        """Finish the submitted work and end the processes."""
        self._threads.shutdown(wait)
        for process in self._processes:
            process.shutdown(wait)

    def _do(self, function: Callable[..., Value], arguments: Tuple[Any, ...], options: Dict[str, Any]) -> Value:
        process = self._idle.get()
        try:
            return process.submit(function, *arguments, **options).result()
        finally:
            self._idle.put(process)
