"""Memory, files, threads and queued bytes of the robot's processes, from /proc. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re
from dataclasses import dataclass
from typing import Dict, Iterable, List, Optional, Set

PROC = pathlib.Path("/proc")
PAGE_MIB = 4096 / 2 ** 20
# Argument with which roslaunch names a node.
_NAME = re.compile(r"__name:=(\w+)")
# Fields of /proc/PID/net/tcp: bytes waiting to be sent and to be read, and the socket's number.
_QUEUES, _INODE = 4, 9


@dataclass(frozen=True)
class Usage:
    """Usage of one process. private_mib: resident private memory; queued_bytes: in its sockets, both directions."""

    private_mib: float
    files: int
    threads: int
    queued_bytes: int


def below(parent: int, proc: pathlib.Path = PROC) -> Dict[int, str]:
    """Return the descendants of a process, each with the name of its node or program."""
    children: Dict[int, List[int]] = {}
    for stat in proc.glob("[0-9]*/stat"):
        try:
            after_name = stat.read_text(encoding="ascii", errors="replace").rpartition(")")[2].split()
        except OSError:
            continue
        children.setdefault(int(after_name[1]), []).append(int(stat.parent.name))
    found, waiting = {}, list(children.get(parent, []))
    while waiting:
        process = waiting.pop()
        found[process] = _name(proc / str(process))
        waiting += children.get(process, [])
    return found


def usage_of(process: int, waiting: Dict[str, int], proc: pathlib.Path = PROC) -> Optional[Usage]:
    """Return the current usage of a process; None if it has ended. waiting: bytes by socket number, see
    waiting_bytes."""
    folder = proc / str(process)
    try:
        pages = (folder / "statm").read_text(encoding="ascii").split()
        threads = len(list((folder / "task").iterdir()))
        files = list((folder / "fd").iterdir())
        sockets = _sockets(files)
    except OSError:
        return None
    return Usage((int(pages[1]) - int(pages[2])) * PAGE_MIB, len(files), threads,
                 sum(waiting.get(number, 0) for number in sockets))


def waiting_bytes(proc: pathlib.Path = PROC) -> Dict[str, int]:
    """Return the bytes in the queues of all TCP sockets, by socket number."""
    found: Dict[str, int] = {}
    for name in ("tcp", "tcp6"):
        path = proc / "net" / name
        for row in path.read_text(encoding="ascii").splitlines()[1:] if path.exists() else []:
            fields = row.split()
            found[fields[_INODE]] = sum(int(part, 16) for part in fields[_QUEUES].split(":"))
    return found


def _name(folder: pathlib.Path) -> str:
    try:
        words = (folder / "cmdline").read_bytes().decode("utf-8", "replace").split("\0")
    except OSError:
        return "gone"
    found = _NAME.search(" ".join(words))
    return found.group(1) if found else pathlib.Path((words[1:2] or words)[0] or words[0]).name


def _sockets(files: Iterable[pathlib.Path]) -> Set[str]:
    found = set()
    for each in files:
        try:
            target = os.readlink(each)
        except OSError:
            continue
        if target.startswith("socket:["):
            found.add(target[len("socket:["):-1])
    return found
