"""The robot's key folder: its own pair and the list of accepted keys, both readable by their owner only."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import fcntl
import os
import pathlib
import threading
from typing import Callable, Iterator, Optional, Tuple

import zmq

from mtr_proto.keys import KeyPair, LinkKeyError, check_writers, own_key_pair, private_folder, write_private

from .authorised_keys import MAX_BYTES, AuthorisedKeys, KeysError, keys_in

FOLDER_NAME = "mtr_link"
OWN_KEYS = "robot.key"
AUTHORISED_KEYS = "authorised_keys.yaml"
_Signature = Optional[Tuple[int, int, int, int]]


class KeyFolder:
    """Key folder, shared by the dispatcher, pairing and the `keys` command. Instances are thread-safe.

    Attributes:
        distrust: why all keys are refused although a list exists; empty if the list is valid.
    """

    def __init__(self, folder: pathlib.Path):
        self._folder, self._list = folder, folder / AUTHORISED_KEYS
        self._lock = threading.Lock()
        self._read: Tuple[_Signature, AuthorisedKeys] = (None, AuthorisedKeys())
        self.distrust = ""

    def own_keys(self) -> KeyPair:
        """Return the robot's pair, generated at the first start; raises KeysError with a sentence."""
        try:
            return own_key_pair(self._folder / OWN_KEYS, zmq.curve_keypair)
        except LinkKeyError as error:
            raise KeysError(str(error)) from None

    def authorised(self) -> AuthorisedKeys:
        """Return the list in the file; if the file cannot be trusted, it is empty and `distrust` has the cause."""
        with self._lock:
            signature = self._signature()
            if signature is None or signature != self._read[0]:
                try:
                    self._read = (signature, self._load())
                except OSError as error:
                    # Without a signature the file is read again later: the limit of open files may be reached
                    # temporarily.
                    self._read = (None, self._nobody(str(error.strerror)))
            return self._read[1]

    def change(self, changed: Callable[[AuthorisedKeys], AuthorisedKeys]) -> AuthorisedKeys:
        """Write the list that `changed` returns; if this fails, raise KeysError with a sentence and change nothing."""
        try:
            private_folder(self._folder)
            with self._alone():
                keys = self.authorised()
                if self.distrust:
                    raise KeysError(self.distrust)
                keys = changed(keys)
                write_private(self._list, keys.to_text())
        except LinkKeyError as error:
            raise KeysError(str(error)) from None
        except OSError as error:
            raise KeysError(f"The list of keys {self._list} cannot be written: {error.strerror}.") from None
        return keys

    @contextlib.contextmanager
    def _alone(self) -> Iterator[None]:
        """Context in which no other process changes the list."""
        with open(self._folder / f".{AUTHORISED_KEYS}.lock", "w", encoding="ascii") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    def _signature(self) -> _Signature:
        try:
            status, rights = os.stat(self._list), os.stat(self._folder).st_mode
        except OSError:
            return None
        # A change of the permissions affects whether the file can be trusted.
        return status.st_ino, status.st_ctime_ns, status.st_size, rights

    def _load(self) -> AuthorisedKeys:
        self.distrust = ""
        try:
            check_writers(self._folder, os.stat(self._folder))
            with open(self._list, encoding="utf-8") as file:
                check_writers(self._list, os.fstat(file.fileno()))
                return keys_in(file.read(MAX_BYTES + 1))
        except FileNotFoundError:
            return AuthorisedKeys()
        except (UnicodeDecodeError, KeysError, LinkKeyError) as error:
            return self._nobody(str(error))

    def _nobody(self, reason: str) -> AuthorisedKeys:
        self.distrust = f"Nobody is accepted: the list of keys {self._list} cannot be used. {reason.rstrip('.')}."
        return AuthorisedKeys()
