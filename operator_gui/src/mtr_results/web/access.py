"""Access to the server: this computer only, or others with a token over TLS."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import ipaddress
import pathlib
from dataclasses import dataclass

from ..errors import StoreError

PORT = 8321
MIN_TOKEN = 16
_LOCAL = frozenset({"localhost", "127.0.0.1", "[::1]"})


@dataclass(frozen=True)
class Access:
    """Attributes: host, port: listening address. token_file: file with the token. certificate, key: for TLS.
    behind_proxy: a proxy in front of this server terminates TLS."""

    host: str = "127.0.0.1"
    port: int = PORT
    token_file: pathlib.Path | None = None
    certificate: pathlib.Path | None = None
    key: pathlib.Path | None = None
    behind_proxy: bool = False

    @property
    def is_local(self) -> bool:
        """True if only this computer can reach the server."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False

    @property
    def is_encrypted(self) -> bool:
        """True if this server terminates TLS itself."""
        return self.certificate is not None and self.key is not None

    @property
    def hosts(self) -> frozenset[str]:
        """Accepted host names of requests; empty accepts any name if other computers may connect."""
        return _LOCAL | {self.host} if self.is_local and not self.behind_proxy else frozenset()

    @property
    def address(self) -> str:
        """Address for a browser."""
        name = f"[{self.host}]" if ":" in self.host else self.host
        return f"{'https' if self.is_encrypted else 'http'}://{name}:{self.port}/"

    def token(self) -> str:
        """Return the token, or an empty text if none is required.

        Raises StoreError if others could read without a token or without encryption.
        """
        if (self.certificate is None) != (self.key is None):
            raise StoreError("TLS needs both --certificate and --key.")
        found = _token_in(self.token_file) if self.token_file else ""
        is_reached = not self.is_local or self.behind_proxy
        if is_reached and not found:
            raise StoreError("Other computers could read; give --token-file with a token, or serve on 127.0.0.1.")
        if is_reached and not self.is_encrypted and not self.behind_proxy:
            raise StoreError(f"On {self.host} the token would be sent in the clear; give --certificate and --key, or "
                             "--behind-proxy where a proxy does TLS.")
        return found


def _token_in(path: pathlib.Path) -> str:
    try:
        found = path.read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        raise StoreError(f"The token in {path} cannot be read: {error}.") from None
    if len(found) < MIN_TOKEN:
        raise StoreError(f"The token in {path} has {len(found)} characters; {MIN_TOKEN} are the fewest.")
    return found
