"""UDS requests and answers over ISO-TP, frame by frame and without threads: by can-isotp and udsoncan."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import contextlib
import logging

import isotp
import udsoncan
from udsoncan.services import ReadDataByIdentifier

from .addresses import Addresses

# Its warnings are for programmers: an incomplete answer is discarded.
logging.getLogger(isotp.TransportLayerLogic.LOGGER_NAME).addHandler(logging.NullHandler())
logging.getLogger(isotp.TransportLayerLogic.LOGGER_NAME).propagate = False
# The poller itself detects the missing answers that the libraries count.
_PARAMETERS = {"blocking_send": False}
_IDENTIFIER_BYTES = 2


class AnsweredValues:
    """Decoder of frames that returns the data of an identifier when an answer with it is complete.

    Attributes:
        outgoing: frame data to be sent to the ECU, such as flow control; ignored in listen-only mode.
    """

    def __init__(self, addresses: Addresses, data_identifier: int):
        self.outgoing: collections.deque[bytes] = collections.deque(maxlen=64)
        self._addresses = addresses
        self._data_identifier = data_identifier
        self._incoming: collections.deque[isotp.CanMessage] = collections.deque()
        mode = isotp.AddressingMode.Normal_29bits if addresses.is_extended else isotp.AddressingMode.Normal_11bits
        self._layer = isotp.TransportLayerLogic(
            rxfn=lambda _: self._incoming.popleft() if self._incoming else None,
            txfn=lambda message: self.outgoing.append(bytes(message.data)),
            address=isotp.Address(mode, rxid=addresses.response_id, txid=addresses.request_id),
            error_handler=lambda _: None, params=_PARAMETERS)

    def ask(self) -> None:
        """Append a request to outgoing."""
        request = udsoncan.Request(ReadDataByIdentifier, data=self._data_identifier.to_bytes(_IDENTIFIER_BYTES, "big"))
        self._layer.send(request.get_payload())
        self._layer.process(rx_timeout=0.0)

    def frame(self, can_id: int, is_extended: bool, data: bytes) -> bytes | None:
        """Return the data of the identifier if this frame completes an answer with it."""
        if can_id != self._addresses.response_id or is_extended != self._addresses.is_extended:
            return None
        self._incoming.append(isotp.CanMessage(arbitration_id=can_id, extended_id=is_extended, data=data))
        self._layer.process(rx_timeout=0.0)
        payload = self._layer.recv() if self._layer.available() else None
        return None if payload is None else self._value(bytes(payload))

    def _value(self, payload: bytes) -> bytes | None:
        """Return the data; None for a rejection, for an answer to another request, and for an invalid answer."""
        response = None
        with contextlib.suppress(ValueError, udsoncan.exceptions.InvalidResponseException):
            response = udsoncan.Response.from_payload(payload)
        if response is None or not response.positive or response.service is not ReadDataByIdentifier:
            return None
        data = bytes(response.data or b"")
        identifier = data[:_IDENTIFIER_BYTES]
        return data[_IDENTIFIER_BYTES:] if int.from_bytes(identifier, "big") == self._data_identifier else None
