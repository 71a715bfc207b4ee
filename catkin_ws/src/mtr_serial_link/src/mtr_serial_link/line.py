"""Thread that runs a session on a port: opens, reads, writes, and reopens after a reconnection."""
# SPDX-License-Identifier: Apache-2.0
import collections
import contextlib
import os
import select
import threading
import time
from typing import Callable, Deque, Dict, Iterable

from .port import PortError, SerialPort
from .send_queue import SendQueue
from .session import SerialSession, SessionEvent

TICK_S = 0.1
MIN_BACKOFF_S = 0.2
MAX_BACKOFF_S = 2.0
# A topic that is faster than the line loses its oldest messages.
MAX_QUEUED_PER_TOPIC = 4


class LineObserver:
    """Callbacks in the line's thread; the default implementation does nothing."""

    def event(self, event: SessionEvent) -> None:
        """Handle an event of the session."""

    def closed(self, reason: str) -> None:
        """Handle the loss of the port; all knowledge about the device is invalid."""

    def tick(self, now_s: float) -> None:
        """Called in each iteration, at least once in TICK_S."""

    def ended(self) -> None:
        """Handle the end of the thread."""


class SerialLine:
    """Thread of the port.

    Attributes:
        session: with the device; only for use in the line's thread, except for its health.
        trouble: reason why the port is not open, empty if it is.
        dropped: messages and frames that were too old, exceeded the line's capacity, or preceded a gap.
    """

    def __init__(self, open_port: Callable[[], SerialPort], session: SerialSession, observer: LineObserver):
        self._open_port = open_port
        self._observer = observer
        self._queues: Dict[str, Deque[bytes]] = {}
        self._lock = threading.Lock()
        self._wake_read, self._wake_write = os.pipe()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._main, name="serial line", daemon=True)
        self._unsent = SendQueue()
        self._outrun = 0
        self.session = session
        self.trouble = ""

    @property
    def dropped(self) -> int:
        """See above."""
        return self._outrun + self._unsent.dropped

    def start(self) -> None:
        """Start the thread."""
        os.set_blocking(self._wake_write, False)
        self._thread.start()

    def stop(self) -> None:
        """Send a stop message to the device and end; returns after the port is closed."""
        self._stopping.set()
        self._wake()
        self._thread.join()

    def send(self, name: str, payload: bytes) -> None:
        """Queue a message for the device; thread-safe."""
        with self._lock:
            queue = self._queues.setdefault(name, collections.deque(maxlen=MAX_QUEUED_PER_TOPIC))
            self._outrun += len(queue) == MAX_QUEUED_PER_TOPIC
            queue.append(payload)
        self._wake()

    def _wake(self) -> None:
        # A full pipe means that the thread is already awake.
        with contextlib.suppress(BlockingIOError):
            os.write(self._wake_write, b"w")

    def _main(self) -> None:
        try:
            self._run()
        finally:
            self._observer.ended()

    def _run(self) -> None:
        backoff_s = MIN_BACKOFF_S
        while not self._stopping.is_set():
            try:
                port = self._open_port()
            except PortError as error:
                self.trouble = str(error)
                self._observer.tick(time.monotonic())
                self._stopping.wait(backoff_s)
                backoff_s = min(2.0 * backoff_s, MAX_BACKOFF_S)
                continue
            backoff_s = MIN_BACKOFF_S
            try:
                self._serve(port)
                reason = ""
            except PortError as error:
                reason = str(error)
            port.close()
            self.trouble = reason
            self.session.endpoints.clear()
            self._observer.closed(reason)

    def _serve(self, port: SerialPort) -> None:
        """Serve the port until stopped; PortError if the port is lost."""
        self.trouble = ""
        self._unsent.clear()
        self.session.outbox.clear()
        # Messages queued without a port are outdated.
        self._take_queued(is_deaf=True)
        self.session.start(time.monotonic())
        ready = select.poll()
        ready.register(self._wake_read, select.POLLIN)
        while not self._stopping.is_set():
            self._write(port)
            ready.register(port.fd, select.POLLIN | (select.POLLOUT if self._unsent else 0))
            woken = dict(ready.poll(1000.0 * TICK_S))
            now_s = time.monotonic()
            if port.fd in woken and woken[port.fd] & ~select.POLLOUT:
                self._pass_on(self.session.receive(port.read(), now_s))
            if self._wake_read in woken:
                os.read(self._wake_read, 4096)
            self._take_queued(self._unsent.is_deaf(now_s))
            self._pass_on(self.session.tick(now_s))
            self._observer.tick(now_s)
        self.session.stop()
        self._write(port)

    def _pass_on(self, events: Iterable[SessionEvent]) -> None:
        for event in events:
            self._observer.event(event)

    def _take_queued(self, is_deaf: bool) -> None:
        with self._lock:
            queues, self._queues = self._queues, {}
        if is_deaf:
            self._outrun += sum(map(len, queues.values()))
            return
        for name, queue in queues.items():
            for payload in queue:
                self.session.send(name, payload)

    def _write(self, port: SerialPort) -> None:
        now_s = time.monotonic()
        self._unsent.put(self.session.outbox, now_s)
        self.session.outbox.clear()
        while True:
            data = self._unsent.next(now_s)
            count = port.write(data) if data else 0
            self._unsent.taken(count)
            if not data or count < len(data):
                return
