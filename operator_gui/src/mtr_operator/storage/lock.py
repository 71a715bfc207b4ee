"""One application at a time writes the files of a test; the system forgets a lock with the process that held it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import os
import pathlib
import sys
from typing import Iterator

from mtr_operator.domain.errors import InUse, OutputError

# Attempts to lock a file that another application takes away just then.
_ATTEMPTS = 10
_MAX_OWNER_BYTES = 32
# Windows refuses to delete a file that is open.
_CAN_UNLINK_OPEN_FILES = sys.platform != "win32"
# A link under this name is not ours, whatever it leads to.
_FLAGS = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)


class Lock:
    """Context in which this application alone writes the test; InUse when another one does, and says which.

    is_shared: nobody writes it, and others may hold it so at the same time; on Windows they may not.
    """

    def __init__(self, path: pathlib.Path, *, is_shared: bool = False):
        self._path = _lock_of(path)
        self._is_shared = is_shared
        self._descriptor: int | None = None

    def __enter__(self) -> Lock:
        try:
            for _ in range(_ATTEMPTS):
                if self._take():
                    return self
        except OSError as error:
            raise OutputError(f"The folder {self._path.parent} cannot be locked against other applications: "
                              f"{error.strerror or error}.") from None
        raise InUse(self.sentence)

    def __exit__(self, *_: object) -> None:
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is None:
            return
        is_last = self._is_last(descriptor)
        if not _CAN_UNLINK_OPEN_FILES:
            os.close(descriptor)
        # Before it is closed where possible: an application that locks the file after this finds that it is gone.
        if is_last:
            with contextlib.suppress(OSError):
                self._path.unlink()
        if _CAN_UNLINK_OPEN_FILES:
            os.close(descriptor)

    def _is_last(self, descriptor: int) -> bool:
        """True for the last one of those that share it, who takes the file away; on Windows nobody shares it."""
        with contextlib.suppress(OSError):
            return not self._is_shared or not _CAN_UNLINK_OPEN_FILES or _lock(descriptor)
        return False

    def _take(self) -> bool:
        """True when it is ours; False when the file was not the one in the folder any more."""
        descriptor = os.open(self._path, _FLAGS, 0o644)
        try:
            if not _lock(descriptor, self._is_shared):
                raise InUse(self.sentence)
            if self._is_in_folder(descriptor):
                os.ftruncate(descriptor, 0)
                os.write(descriptor, str(os.getpid()).encode("ascii"))
                self._descriptor = descriptor
                return True
        finally:
            if self._descriptor is None:
                os.close(descriptor)
        return False

    def _is_in_folder(self, descriptor: int) -> bool:
        try:
            return os.path.samestat(os.fstat(descriptor), os.stat(self._path))
        except FileNotFoundError:
            return False

    @property
    def sentence(self) -> str:
        """Who writes the test, and what to do."""
        try:
            owner = self._path.read_bytes()[:_MAX_OWNER_BYTES].decode("ascii", "replace").strip()
        except OSError:
            owner = ""
        process = f" (process {owner})" if owner.isdigit() else ""
        return (f"Another application{process} is measuring the test in the folder {self._path.parent}; end it there "
                "first, or choose another folder.")


@contextlib.contextmanager
def at_rest(path: pathlib.Path) -> Iterator[None]:
    """Context in which no application writes the test with this progress file; InUse when one does.

    A folder in which nothing can be written, such as an archive, has no lock: there its lock file decides.
    """
    lock = Lock(path, is_shared=True)
    with contextlib.ExitStack() as held:
        try:
            held.enter_context(lock)
        except InUse:
            raise
        except OutputError:
            if is_held(path):
                raise InUse(lock.sentence) from None
        yield


def is_held(path: pathlib.Path) -> bool:
    """True while an application writes the test with this progress file, or when one was killed; takes no lock."""
    return os.path.lexists(_lock_of(path))


def _lock_of(path: pathlib.Path) -> pathlib.Path:
    return path.with_name(f".{path.stem}.lock")


if sys.platform == "win32":
    import msvcrt

    # Behind what is written, for Windows lets nobody read what is locked.
    _LOCKED_BYTE = 1024

    def _lock(descriptor: int, is_shared: bool = False) -> bool:
        os.lseek(descriptor, _LOCKED_BYTE, os.SEEK_SET)
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        finally:
            os.lseek(descriptor, 0, os.SEEK_SET)
        return True
else:
    import fcntl

    def _lock(descriptor: int, is_shared: bool = False) -> bool:
        try:
            fcntl.flock(descriptor, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
