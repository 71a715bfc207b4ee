"""CURVE on the robot's sockets: its key pair, and ZeroMQ's authenticator (ZAP, RFC 27) that asks the gate."""
# SPDX-License-Identifier: Apache-2.0
import ipaddress
import logging
from typing import Any, Callable, NamedTuple

import zmq
from zmq.auth.thread import ThreadAuthenticator

from mtr_proto.keys import KeyPair

# Any domain, and a name for it: libzmq asks the authenticator only on sockets that have one.
DOMAIN = "link"
LOCALHOST = "localhost"


class Curve(NamedTuple):
    """What encrypts the link. admits: asked with a public key (Z85) at each connection, in another thread."""

    keys: KeyPair
    admits: Callable[[str], bool]


class _Provider:
    """As zmq.auth asks for it."""

    def __init__(self, admits: Callable[[str], bool]):
        self._admits = admits

    def callback(self, _domain: str, key: bytes) -> bool:
        """True when the key may connect; whatever goes wrong is a no, and the thread goes on."""
        try:
            return self._admits(key.decode("ascii"))
        except Exception:
            logging.exception("A connection was refused, for its key could not be looked up.")
            return False


def authenticator(context: Any, curve: Curve) -> ThreadAuthenticator:
    """A thread that answers ZeroMQ's questions about this context; to be stopped before the context ends."""
    thread = ThreadAuthenticator(context)
    thread.start()
    thread.configure_curve_callback(DOMAIN, _Provider(curve.admits))
    return thread


def encrypt(socket: Any, curve: Curve) -> None:
    """Let nobody on a socket, before it is bound, but whom the authenticator accepts."""
    socket.setsockopt(zmq.CURVE_SERVER, 1)
    socket.setsockopt(zmq.CURVE_PUBLICKEY, curve.keys.public)
    socket.setsockopt(zmq.CURVE_SECRETKEY, curve.keys.secret)
    socket.setsockopt(zmq.ZAP_DOMAIN, DOMAIN.encode("ascii"))


def is_possible() -> bool:
    """True when this libzmq was built with it."""
    return bool(zmq.has("curve"))


def is_loopback(address: str) -> bool:
    """True for an address that only this computer reaches."""
    try:
        return ipaddress.ip_address(address).is_loopback
    except ValueError:
        return address == LOCALHOST
