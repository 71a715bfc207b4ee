"""Ed25519 key with which this computer signs bundles, and the chain of its signatures."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import getpass
import json
import os
import pathlib
import platform
import time
from dataclasses import dataclass
from typing import Any, Iterator

import platformdirs
from nacl.exceptions import BadSignatureError
from nacl.signing import SigningKey, VerifyKey

from mtr_operator.domain.errors import InUse, OperatorError, OutputError
from mtr_operator.storage.atomic import write_bytes
from mtr_operator.storage.lock import Lock

_FOLDER = "evidence"
_KEY, _CHAIN = "signing.key", "chain.json"
_KEY_BYTES = 32
# Writing a bundle of some hundred MB lasts a few seconds.
PATIENCE_S = 30.0
_PAUSE_S = 0.1


class StationKeyError(OperatorError):
    """The key or the chain of this computer cannot be used; the text states the reason."""


@dataclass(frozen=True)
class Link:
    """The newest bundle of a station. number: from 1. manifest: SHA-256 of its manifest, hexadecimal."""

    number: int
    name: str
    manifest: str


class Station:
    """Signer. folder: None for the system's, which no other computer uses.

    Attributes: name: user and computer.
    """

    def __init__(self, folder: pathlib.Path | None = None):
        self._folder = folder or platformdirs.user_data_path("mtr-operator", appauthor=False) / _FOLDER
        self.name = f"{getpass.getuser()}@{platform.node()}"

    @property
    def key(self) -> str:
        """Public key, hexadecimal; created at the first call."""
        return self._signing_key().verify_key.encode().hex()

    def sign(self, content: bytes) -> str:
        """Return the signature, hexadecimal."""
        return self._signing_key().sign(content).signature.hex()

    @contextlib.contextmanager
    def signing(self) -> Iterator[None]:
        """Context with exclusive access to the chain, from its newest bundle to the next one; StationKeyError if
        another application holds it for too long."""
        until_s = time.monotonic() + PATIENCE_S
        with contextlib.ExitStack() as held:
            self._make_folder()
            while True:
                with contextlib.suppress(InUse):
                    held.enter_context(Lock(self._folder / _CHAIN))
                    break
                if time.monotonic() > until_s:
                    raise StationKeyError("Another application is writing a bundle with the key of this station; write "
                                          "this one when it has ended.")
                time.sleep(_PAUSE_S)
            yield

    @property
    def newest(self) -> Link | None:
        """Newest signed bundle; None before the first one."""
        try:
            document: Any = json.loads((self._folder / _CHAIN).read_text(encoding="utf-8"))
            return Link(int(document["number"]), str(document["name"]), str(document["manifest"]))
        except FileNotFoundError:
            return None
        except (OSError, ValueError, KeyError, TypeError):
            raise StationKeyError(f"The chain of bundles in {self._folder / _CHAIN} is damaged; move that file "
                                  "elsewhere to begin a new chain.") from None

    def append(self, link: Link) -> None:
        """Record a bundle that was signed and is on disk."""
        write_bytes(self._folder / _CHAIN, json.dumps(vars(link), indent=1).encode("utf-8"))

    def _signing_key(self) -> SigningKey:
        path = self._folder / _KEY
        try:
            if not path.exists():
                self._make(path)
            seed = bytes.fromhex(path.read_text(encoding="ascii"))
        except OSError as error:
            raise OutputError(f"The key of this station in {path} cannot be read or made: "
                              f"{error.strerror or error}.") from None
        except ValueError:
            seed = b""
        if len(seed) != _KEY_BYTES:
            raise StationKeyError(f"The key of this station in {path} is damaged; restore it from a copy, or move it "
                                  "elsewhere to have a new one made.")
        return SigningKey(seed)

    def _make_folder(self) -> None:
        try:
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        except OSError as error:
            raise OutputError(f"The key of this station in {self._folder / _KEY} cannot be read or made: "
                              f"{error.strerror or error}.") from None

    def _make(self, path: pathlib.Path) -> None:
        self._make_folder()
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with open(descriptor, "w", encoding="ascii") as file:
            file.write(SigningKey.generate().encode().hex())


def is_signed_by(key: str, content: bytes, signature: str) -> bool:
    """Return True if the signature matches content and public key; both hexadecimal."""
    try:
        VerifyKey(bytes.fromhex(key)).verify(content, bytes.fromhex(signature))
    except (BadSignatureError, ValueError, TypeError):
        return False
    return True
