"""Parses listening TCP sockets from /proc/net/tcp and /proc/net/tcp6. Pure."""
# SPDX-License-Identifier: Apache-2.0
import ipaddress
import struct
from dataclasses import dataclass
from typing import List

LISTEN = "0A"
ADDRESS_COLUMN, STATE_COLUMN, INODE_COLUMN = 1, 3, 9


@dataclass(frozen=True)
class ListeningSocket:
    """TCP socket that accepts connections.

    Attributes:
        address: on which it listens, e.g. 0.0.0.0 or ::.
        port: on which it listens.
        inode: by which /proc/PID/fd names it.
    """

    address: str
    port: int
    inode: int

    @property
    def place(self) -> str:
        """Return address and port as one word."""
        return f"[{self.address}]:{self.port}" if ":" in self.address else f"{self.address}:{self.port}"


def is_loopback(address: str) -> bool:
    """Return True for localhost and addresses that only this computer reaches; other names may resolve to anything."""
    if address == "localhost":
        return True
    try:
        found = ipaddress.ip_address(address)
    except ValueError:
        return False
    mapped = found.ipv4_mapped if isinstance(found, ipaddress.IPv6Address) else None
    return (mapped or found).is_loopback


def sockets_in(table: str) -> List[ListeningSocket]:
    """Return the listening sockets in the text of /proc/net/tcp or tcp6; ValueError for another text."""
    rows = [line.split() for line in table.splitlines()[1:]]
    return [_socket_of(row) for row in rows if len(row) > INODE_COLUMN and row[STATE_COLUMN] == LISTEN]


def _socket_of(row: List[str]) -> ListeningSocket:
    address, port = row[ADDRESS_COLUMN].split(":")
    return ListeningSocket(_address_of(address), int(port, 16), int(row[INODE_COLUMN]))


def _address_of(digits: str) -> str:
    # The kernel prints each word of 32 bits as a number, in this machine's byte order.
    words = [int(digits[start:start + 8], 16) for start in range(0, len(digits), 8)]
    return str(ipaddress.ip_address(struct.pack(f"={len(words)}I", *words)))
