"""Long work in a process of its own, so that it takes neither the interpreter's lock nor processor time from a node.

In a thread of the node it does: the thread holds the lock of the interpreter while the scheduler lets others run, and
whoever speaks for the node waits for that.
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
# The longest work, a Car among all returns of a way round, took 5 s of the wall clock beside 16 processes on two cores.
PATIENCE_S = 60.0
# Until a process has imported what its work needs, which takes processor time and reads from the disk.
START_PATIENCE_S = 60.0

Value = TypeVar("Value")


class ProcessExecutor(Executor):
    """Does its work before it returns, one piece at a time; function, arguments and result are pickled.

    The process starts at once and ends with this one, however that ends. When it has died, killed for its memory
    maybe, or is stopped, the work is done here and another process is started.
    """

    def __init__(self, modules: List[str], tell: Callable[[str], None], patience_s: float = PATIENCE_S):
        """modules: names of the modules that the process imports at its start. tell: called with a sentence when the
        process is replaced. patience_s: limit in s for one piece of work, without the start of the process."""
        self._modules, self._tell, self._patience_s = modules, tell, patience_s
        self._lock = threading.Lock()
        self._inline = InlineExecutor()
        self._is_ready = False
        self._start()

    @property
    def process_id(self) -> int:
        """Of the process that does the work."""
        return self._process.pid

    def submit(self, fn: Callable[..., Value], *args: Any, **kwargs: Any) -> "Future[Value]":
        """The work's result."""
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
        """Return when the process has imported its modules; GONE when it has died, or needs too long for it."""
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
        """Kill the process unless the work within is done: one that is stopped does not even receive."""
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
            # In a session of its own no Ctrl-C reaches it, and a scheduler that shares by sessions gives it its own.
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
    """Does several pieces at once, each in a process of its own, beside whoever asks for them."""

    def __init__(self, count: int, modules: List[str], tell: Callable[[str], None]):
        """count: of processes; the rest as ProcessExecutor."""
        self._threads = ThreadPoolExecutor(count)
        self._processes = [ProcessExecutor(modules, tell) for _ in range(count)]
        self._idle: SimpleQueue[ProcessExecutor] = SimpleQueue()
        for process in self._processes:
            self._idle.put(process)

    def submit(self, fn: Callable[..., Value], *args: Any, **kwargs: Any) -> "Future[Value]":
        """The work's result; it can be cancelled until a process is free for it."""
        return self._threads.submit(self._do, fn, args, kwargs)

    def shutdown(self, wait: bool = True, **_: Any) -> None:
        """Let what was asked for be done, and end the processes."""
        self._threads.shutdown(wait)
        for process in self._processes:
            process.shutdown(wait)

    def _do(self, function: Callable[..., Value], arguments: Tuple[Any, ...], options: Dict[str, Any]) -> Value:
        process = self._idle.get()
        try:
            return process.submit(function, *arguments, **options).result()
        finally:
            self._idle.put(process)
