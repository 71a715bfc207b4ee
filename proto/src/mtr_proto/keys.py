"""Key pairs of the link (ZeroMQ CURVE) and the file that holds one; robot and laptop keep theirs the same way."""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import os
import pathlib
import re
import secrets
import stat
from typing import Callable, NamedTuple, Tuple

# Z85 (ZeroMQ RFC 32) of 32 bytes.
KEY = re.compile(r"[0-9A-Za-z.\-:+=^!/*?&<>()\[\]{}@%$#]{40}")
# Rights of group and others, who may have none on a secret, and not write what is trusted.
OTHERS = 0o077
WRITERS = 0o022
_MAX_BYTES = 4096
_HEADER = "# Key pair of the link, ZeroMQ CURVE in Z85. Whoever reads the secret key can speak in this name.\n"


class LinkKeyError(Exception):
    """A key or its file cannot be used; the text is one sentence for a person."""


class KeyPair(NamedTuple):
    """Both keys as ZeroMQ takes them, Z85. The text of a pair does not show the secret one."""

    public: bytes
    secret: bytes

    def __repr__(self) -> str:
        return f"KeyPair({self.public.decode('ascii')})"


def is_key(text: str) -> bool:
    """True for the form of a key."""
    return KEY.fullmatch(text) is not None


def fingerprint(public_key: str) -> str:
    """What two persons compare: 16 hexadecimal digits of SHA-256 in groups of four."""
    digits = hashlib.sha256(public_key.encode("utf-8")).hexdigest()[:16]
    return " ".join(digits[start:start + 4] for start in range(0, 16, 4))


def private_folder(folder: pathlib.Path) -> pathlib.Path:
    """The folder, made for its owner alone when it was not there.

    Raises:
        LinkKeyError: it cannot be made, or others may write it.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        check_writers(folder, folder.stat())
    except OSError as error:
        raise LinkKeyError(f"The folder {folder} of the link's keys cannot be made: {error.strerror}.") from None
    return folder


def check_writers(path: pathlib.Path, status: os.stat_result) -> None:
    """Raise LinkKeyError with a sentence when others than its owner may write this file or folder."""
    # Windows keeps a person's own folder from others by itself, and knows no such bits.
    if os.name == "posix" and status.st_mode & WRITERS:
        rights = "700" if stat.S_ISDIR(status.st_mode) else "600"
        raise LinkKeyError(f"Others may write {path}; say chmod {rights} {path}.")


def own_key_pair(path: pathlib.Path, make: Callable[[], Tuple[bytes, bytes]]) -> KeyPair:
    """The pair in the file, made by `make` (zmq.curve_keypair) when there is none.

    Raises:
        LinkKeyError: the file cannot be read or written, is damaged, or others may read it or write its folder.
    """
    private_folder(path.parent)
    if not path.exists():
        _write_new(path, KeyPair(*make()))
    return _read(path)


def write_private(path: pathlib.Path, text: str) -> None:
    """Replace the file by one with this text that its owner alone can read; returns when it is safe. Raises OSError."""
    part = _new_part(path, text)
    try:
        os.replace(part, path)
    except OSError:
        part.unlink()
        raise
    _sync_folder(path.parent)


def _write_new(path: pathlib.Path, pair: KeyPair) -> None:
    """Two programs may make the file at once; the first one's stands, and neither reads half of one."""
    try:
        part = _new_part(path, f"{_HEADER}public {pair.public.decode('ascii')}\nsecret {pair.secret.decode('ascii')}\n")
        try:
            os.link(part, path)
        except FileExistsError:
            pass
        finally:
            part.unlink()
        _sync_folder(path.parent)
    except OSError as error:
        raise LinkKeyError(f"The link's keys cannot be written to {path}: {error.strerror}.") from None


def _new_part(path: pathlib.Path, text: str) -> pathlib.Path:
    part = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    descriptor = os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
    try:
        with open(descriptor, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
    except BaseException:
        # On a full disk each try would leave one, perhaps with a secret key in it.
        part.unlink()
        raise
    return part


def _sync_folder(folder: pathlib.Path) -> None:
    """Make the names in a folder safe against a loss of power."""
    # Windows has no such thing: there the file system's journal keeps the new name.
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _read(path: pathlib.Path) -> KeyPair:
    try:
        # For Windows see check_writers.
        if os.name == "posix" and path.stat().st_mode & OTHERS:
            raise LinkKeyError(f"Others may read the secret key in {path}; say chmod 600 {path}, or delete it and pair "
                               "anew.")
        with open(path, encoding="utf-8") as file:
            lines = file.read(_MAX_BYTES).splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is no text"
        raise LinkKeyError(f"The link's keys in {path} cannot be read: {reason}.") from None
    found = dict(line.split(" ", 1) for line in lines if " " in line)
    public, secret = found.get("public", ""), found.get("secret", "")
    if not is_key(public) or not is_key(secret):
        raise LinkKeyError(f"The link's keys in {path} are damaged; delete the file and pair anew.")
    return KeyPair(public.encode("ascii"), secret.encode("ascii"))
