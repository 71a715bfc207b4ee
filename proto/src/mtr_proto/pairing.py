"""Pairing: robot and laptop exchange their public keys, authenticated by a short code that a person carries.

SPAKE2 (RFC 9382, in the form of the package `spake2`, Ed25519) derives a common secret from the code. Both sides then
prove with HMAC-SHA256 over all messages that they have the same code and have seen the same keys. An attacker who
guesses or is in between has one guess per try and learns only whether it was right; the robot counts the tries.

  laptop -> robot   HELLO     magic, SPAKE2 of the laptop, its public key, its name
  robot  -> laptop  ANSWER    SPAKE2 of the robot, its public key
  laptop -> robot   PROOF     of the laptop
  robot  -> laptop  WELCOME   role, proof of the robot

Every message has a fixed length, so neither side ever reads more.
"""
# SPDX-License-Identifier: Apache-2.0
import hashlib
import hmac
import re
import secrets
from typing import Any, NamedTuple, Tuple

from .keys import is_key

try:
    from spake2 import SPAKE2_A, SPAKE2_B
except ImportError:
    SPAKE2_A = SPAKE2_B = None

PORT = 3335
CODE_DIGITS = 6
NAME_BYTES = 64
ROLES = ("controller", "viewer")

_MAGIC = b"MTRPAIR1"
_POINT, _KEY, _PROOF = 33, 40, 32
HELLO_BYTES = len(_MAGIC) + _POINT + _KEY + NAME_BYTES
ANSWER_BYTES = _POINT + _KEY
PROOF_BYTES = _PROOF
WELCOME_BYTES = 1 + _PROOF
_IDS = {"idA": b"mtr operator", "idB": b"mtr robot"}


class PairingError(Exception):
    """The received data is not a message of a pairing; the text is one sentence for a person."""


class WrongCode(PairingError):
    """The other side has another code, or an attacker is in between."""


class Hello(NamedTuple):
    """The laptop's own data; trustworthy only after its proof."""

    public_key: str
    name: str


class Paired(NamedTuple):
    """The laptop's result of a pairing."""

    robot_key: str
    role: str


def new_code() -> str:
    """Return a new code for one pairing."""
    return f"{secrets.randbelow(10 ** CODE_DIGITS):0{CODE_DIGITS}d}"


def code_of(typed: str) -> str:
    """Return the code in a typed text, which may contain spaces or dashes.

    Raises:
        PairingError: the text is not a code.
    """
    digits = re.sub(r"[\s-]", "", typed)
    if not re.fullmatch(rf"[0-9]{{{CODE_DIGITS}}}", digits):
        raise PairingError(f"The code has {CODE_DIGITS} digits; the robot shows it.")
    return digits


def plain_name(name: str) -> str:
    """Return the name for one line of a file or log: printable, at most NAME_BYTES long in UTF-8, never empty."""
    words = " ".join("".join(letter if letter.isprintable() else " " for letter in name).split())
    return words.encode("utf-8")[:NAME_BYTES].decode("utf-8", "ignore").strip() or "unnamed"


class LaptopSide:
    """The laptop's side of one try; call its methods in this order: hello, proof, welcomed."""

    def __init__(self, code: str, public_key: bytes, name: str):
        self._secret = _spake2(SPAKE2_A, code)
        self._hello = _MAGIC + self._secret.start() + public_key + plain_name(name).encode("utf-8").ljust(NAME_BYTES,
                                                                                                       b"\0")
        self._key, self._said, self._robot_key = b"", b"", ""

    def hello(self) -> bytes:
        """Return the first message."""
        return self._hello

    def proof(self, answer: bytes) -> bytes:
        """Return the third message; raises PairingError if the answer is invalid."""
        point, key = _split(answer, (_POINT, _KEY))
        self._robot_key = _key_text(key)
        self._key, self._said = _common(self._secret, point), self._hello + answer
        return _proof(self._key, b"laptop", self._said)

    def welcomed(self, welcome: bytes) -> Paired:
        """Return the robot's key and this laptop's role; raises WrongCode without a valid proof of the robot."""
        number, proof = _split(welcome, (1, _PROOF))
        if number[0] >= len(ROLES) or not hmac.compare_digest(proof, _proof(self._key, b"robot" + number, self._said)):
            raise WrongCode("The robot's answer does not fit the code; begin anew with a new code.")
        return Paired(self._robot_key, ROLES[number[0]])


class RobotSide:
    """The robot's side of one try: answer counts as the try, welcome completes it."""

    def __init__(self, code: str, public_key: bytes):
        self._secret = _spake2(SPAKE2_B, code)
        self._public_key = public_key
        self._key, self._said = b"", b""

    def answer(self, hello: bytes) -> Tuple[Hello, bytes]:
        """Return the laptop's data and the second message; raises PairingError for an invalid hello."""
        magic, point, key, name = _split(hello, (len(_MAGIC), _POINT, _KEY, NAME_BYTES))
        if magic != _MAGIC:
            raise PairingError("Something else than a laptop that wants to be paired has spoken.")
        said = Hello(_key_text(key), plain_name(name.rstrip(b"\0").decode("utf-8", "replace")))
        answer: bytes = self._secret.start() + self._public_key
        self._key, self._said = _common(self._secret, point), hello + answer
        return said, answer

    def welcome(self, proof: bytes, role: str) -> bytes:
        """Return the fourth message; raises WrongCode if the laptop has another code."""
        if not hmac.compare_digest(proof, _proof(self._key, b"laptop", self._said)):
            raise WrongCode("The code was wrong.")
        number = bytes([ROLES.index(role)])
        return number + _proof(self._key, b"robot" + number, self._said)


def _spake2(side: Any, code: str) -> Any:
    if side is None:
        raise PairingError("Pairing needs the Python package spake2: apt install python3-spake2, or pip install "
                           "spake2.")
    return side(code.encode("ascii"), **_IDS)


def _common(secret: Any, point: bytes) -> bytes:
    try:
        key: bytes = secret.finish(point)
        return key
    # The bytes come from the network, and the package raises various errors for an invalid point.
    except Exception:
        raise PairingError("What has come is no message of a pairing.") from None


def _proof(key: bytes, side: bytes, said: bytes) -> bytes:
    return hmac.new(key, b"mtr pairing " + side + hashlib.sha256(said).digest(), hashlib.sha256).digest()


def _split(data: bytes, lengths: Tuple[int, ...]) -> Tuple[bytes, ...]:
    if len(data) != sum(lengths):
        raise PairingError("What has come is no message of a pairing.")
    ends = [sum(lengths[:count + 1]) for count in range(len(lengths))]
    return tuple(data[end - length:end] for end, length in zip(ends, lengths))


def _key_text(key: bytes) -> str:
    text = key.decode("ascii", "replace")
    if not is_key(text):
        raise PairingError("What has come is no message of a pairing.")
    return text
