"""Texts of others in documents of every kind: each is replaced in turn by what does harm where it is trusted."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import copy
import os
import socket

# All of them with MTR_HOSTILE=all, else a few of them for each text, in turn.
ALL_VALUES = os.environ.get("MTR_HOSTILE") == "all"
VALUES_PER_TEXT = 2
# Behind the place of a value: its key is meant.
KEY = object()
SECRET = b"-----BEGIN OPENSSH PRIVATE KEY-----\n"
PICTURE_FROM_ELSEWHERE = "<img src='http://192.0.2.1/x'>"


def values(root):
    """Hostile texts by what each is. root: of the sandbox."""
    return {
        "up": "../x", "far up": "../../../../x.jpg", "absolute": f"{root}/evil", "drive": "C:x",
        "share": "//192.0.2.1/x", "link": "http://192.0.2.1/x", "mathematics": "$\\x$", "operator": "K$%Q$",
        "formula": "=1", "command": "@SUM(1)|x", "markup": "<b>", "picture": PICTURE_FROM_ELSEWHERE,
        "script": "\"><script>alert(1)</script>", "long": 10 ** 6 * "x", "NUL": "a\0b",
        "right to left": "a\u202egpj.exe\u200f", "terminal": "a\x1b[2Jb", "lines": "a\nb\r\nc",
        "half a character": "a\ud800b", "percent": "%(default)s %n {} {x}", "empty": ""}


def texts(document, place=()):
    """Place of each text of a document: keys and indices that lead to it; a key itself is marked by KEY at the end."""
    if isinstance(document, dict):
        for key, value in document.items():
            yield (*place, key, KEY)
            yield from texts(value, (*place, key))
    elif isinstance(document, list):
        for index, value in enumerate(document):
            yield from texts(value, (*place, index))
    elif isinstance(document, str):
        yield place


def changed(document, *changes):
    """A copy of a document with other texts: pairs of a place and a text."""
    found = copy.deepcopy(document)
    for place, text in changes:
        is_key = place[-1] is KEY
        *way, last = place[:-1] if is_key else place
        part = found
        for step in way:
            part = part[step]
        if is_key:
            part[text] = part.pop(last)
        else:
            part[last] = text
    return found


def cases(document, root):
    """Pairs of a place and the name of a value: in the short form a few values for each text, so that neighbours in the
    document get different ones."""
    names = list(values(root))
    for number, place in enumerate(texts(document)):
        if ALL_VALUES:
            yield from ((place, name) for name in names)
        else:
            first = number * VALUES_PER_TEXT
            yield from ((place, names[(first + index) % len(names)]) for index in range(VALUES_PER_TEXT))


def place_text(place):
    """For a person who reads that a case fails."""
    return "/".join("(key)" if step is KEY else str(step)[:30] for step in place)


class Sandbox:
    """A home with secrets, and folders in which alone something may be written.

    Attributes: home: of the person. chosen: folder in which everything may change.
    """

    def __init__(self, root, monkeypatch):
        self.root, self.home, self.chosen = root, root / "home", root / "home" / "a" / "b" / "chosen"
        self.chosen.mkdir(parents=True)
        (self.home / ".ssh").mkdir()
        (self.home / ".ssh" / "id_ed25519").write_bytes(SECRET)
        for name in (".bashrc", "x", "x.jpg"):
            (self.home / name).write_text("mine", encoding="utf-8")
        (self.home / "working").mkdir()
        for variable, folder in (("HOME", self.home), ("XDG_CONFIG_HOME", root / "programs" / "config"),
                                 ("XDG_DATA_HOME", root / "programs" / "data"),
                                 ("XDG_CACHE_HOME", root / "programs" / "cache"),
                                 ("XDG_RUNTIME_DIR", root / "programs" / "runtime")):
            monkeypatch.setenv(variable, str(folder))
        monkeypatch.chdir(self.home / "working")
        self._before = self._seen()

    def check(self):
        """Fail when something outside the chosen folder is not as it was."""
        now = self._seen()
        other = sorted(name for name in now.keys() | self._before if now.get(name) != self._before.get(name))
        assert not other, other
        assert not os.path.lexists("/x") and not os.path.lexists("/x.jpg")

    def _seen(self):
        free = {self.chosen, self.root / "programs"}
        return {str(path): path.read_bytes() if path.is_file() else b"" for path in self.root.rglob("*")
                if not free & {path, *path.parents}}


@contextlib.contextmanager
def no_requests(monkeypatch):
    """Context in which nothing may be asked of the network."""
    asked = []

    def refuse(*arguments, **_):
        asked.append(arguments)
        raise OSError("the network is asked")
    with monkeypatch.context() as patched:
        for name in ("connect", "connect_ex", "sendto"):
            patched.setattr(socket.socket, name, refuse)
        patched.setattr(socket, "getaddrinfo", refuse)
        patched.setattr(socket, "create_connection", refuse)
        yield
    assert not asked


