"""ECU that answers requests for the lock state, for a simulated Car on a bus."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections

import can
import isotp
import udsoncan
from udsoncan.services import ReadDataByIdentifier

from .declared import UdsPoll

_REQUEST_OUT_OF_RANGE = 0x31


class SpokenEcu:
    """Simulated ECU. Attributes: raw: value of the state in its answers."""

    def __init__(self, poll: UdsPoll, bus: can.BusABC):
        self.raw = 0
        self._sent = 0
        self._poll = poll
        self._bus = bus
        self._incoming: collections.deque[isotp.CanMessage] = collections.deque()
        addresses = poll.addresses
        mode = isotp.AddressingMode.Normal_29bits if addresses.is_extended else isotp.AddressingMode.Normal_11bits
        self._layer = isotp.TransportLayerLogic(
            rxfn=lambda _: self._incoming.popleft() if self._incoming else None, txfn=self._send,
            address=isotp.Address(mode, rxid=addresses.request_id, txid=addresses.response_id),
            params={"blocking_send": False})

    def answer(self, patience_s: float) -> int:
        """Wait for a request and answer it completely; return the number of sent frames, 0 without a request in
        time."""
        before = self._sent
        while self._take(self._bus.recv(patience_s)) and (self._sent == before or self._layer.transmitting()):
            pass
        return self._sent - before

    def _take(self, message: can.Message | None) -> bool:
        """Return False without a frame, or for a frame that is not from the tester."""
        if message is None or message.arbitration_id != self._poll.addresses.request_id:
            return False
        self._incoming.append(isotp.CanMessage(arbitration_id=message.arbitration_id,
                                               extended_id=message.is_extended_id, data=bytes(message.data)))
        self._layer.process(rx_timeout=0.0)
        if self._layer.available():
            self._layer.send(self._response(bytes(self._layer.recv() or b"")))
            self._layer.process(rx_timeout=0.0)
        return True

    def _response(self, payload: bytes) -> bytes:
        poll, wanted = self._poll, self._poll.data_identifier.to_bytes(2, "big")
        if udsoncan.Request.from_payload(payload).data != wanted:
            return bytes(udsoncan.Response(ReadDataByIdentifier, _REQUEST_OUT_OF_RANGE).get_payload())
        data = wanted + bytes(poll.byte) + bytes([self.raw * (poll.mask & -poll.mask)])
        return bytes(udsoncan.Response(ReadDataByIdentifier, 0, data).get_payload())

    def _send(self, message: isotp.CanMessage) -> None:
        self._sent += 1
        self._bus.send(can.Message(arbitration_id=message.arbitration_id, is_extended_id=message.is_extended_id,
                                   data=bytes(message.data)))
