"""The thread that reads the adapter outlives whatever its driver does (E3)."""
# SPDX-License-Identifier: Apache-2.0
import queue
import termios

import pytest

from mtr_operator.car_link.reader import CanReader, FrameSink

LIMIT_S = 20.0


class Sink(FrameSink):
    def __init__(self):
        self.said = queue.Queue()

    def frame(self, frame):
        pass

    def error_frame(self):
        pass

    def frames_lost(self):
        pass

    def fault(self, text):
        self.said.put(text)

    def reopened(self):
        self.said.put("reopened")


class Bus:
    """Fails at once, or is silent."""

    def __init__(self, error=None):
        self._error = error

    def recv(self, timeout):
        if self._error:
            raise self._error

    def shutdown(self):
        pass


@pytest.mark.parametrize("error", [termios.error(5, "Input/output error"), OSError(5, "gone"), ValueError("vendor")])
def test_exception_while_the_adapter_is_opened_again_is_said_and_tried_again(monkeypatch, error):
    monkeypatch.setattr("mtr_operator.car_link.reader._REOPEN_PERIOD_S", 0.01)
    opened = iter([Bus(OSError("unplugged")), error, Bus()])

    def open_bus():
        bus = next(opened)
        if isinstance(bus, Exception):
            raise bus
        return bus
    sink = Sink()
    reader = CanReader(open_bus, sink)
    reader.start()
    try:
        assert "unplugged" in sink.said.get(timeout=LIMIT_S)
        assert "The CAN adapter has failed" in sink.said.get(timeout=LIMIT_S)
        assert sink.said.get(timeout=LIMIT_S) == "reopened"
        assert sink.said.get(timeout=LIMIT_S) == ""
    finally:
        reader.stop()
