"""CURVE on the robot's sockets: its key pair, and ZeroMQ's authenticator (ZAP, RFC 27), which queries the gate."""
# SPDX-License-Identifier: Apache-2.0
import ipaddress
import logging
from typing import Any, Callable, NamedTuple

import zmq
from zmq.auth.thread import ThreadAuthenticator

from mtr_proto.keys import KeyPair

# The authenticator accepts any domain, but libzmq queries it only for sockets with a non-empty one.
DOMAIN = "link"
LOCALHOST = "localhost"


class Curve(NamedTuple):
    """Encryption of the link. admits: called in another thread with a public key (Z85) at each connection."""

    keys: KeyPair
    admits: Callable[[str], bool]


class _Provider:
    """Credentials provider for zmq.auth."""

    def __init__(self, admits: Callable[[str], bool]):
        self._admits = admits

    def callback(self, _domain: str, key: bytes) -> bool:
        """Return True if the key may connect; any error is a refusal, so that the thread keeps running."""
        try:
            return self._admits(key.decode("ascii"))
        except Exception:
            logging.exception("A connection was refused, for its key could not be looked up.")
            return False


def authenticator(context: Any, curve: Curve) -> ThreadAuthenticator:
    """Start the thread that authenticates peers of this context; stop it before the context ends."""
    thread = ThreadAuthenticator(context)
    thread.start()
    thread.configure_curve_callback(DOMAIN, _Provider(curve.admits))
    return thread


def encrypt(socket: Any, curve: Curve) -> None:
    """Restrict a socket to peers that the authenticator accepts; call it before the socket is bound."""
    socket.setsockopt(zmq.CURVE_SERVER, 1)
    socket.setsockopt(zmq.CURVE_PUBLICKEY, curve.keys.public)
    socket.setsockopt(zmq.CURVE_SECRETKEY, curve.keys.secret)
    socket.setsockopt(zmq.ZAP_DOMAIN, DOMAIN.encode("ascii"))


def is_possible() -> bool:
    """Return True if this libzmq was built with CURVE."""
    return bool(zmq.has("curve"))


def is_loopback(address: str) -> bool:
    """Return True for an address that only this computer can reach."""
    try:
        return ipaddress.ip_address(address).is_loopback
    except ValueError:
        return address == LOCALHOST
