"""Reads the graph from the ROS master and the system's sockets."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import http.client
import os
import pathlib
import re
import xmlrpc.client
from typing import Any, Dict, FrozenSet, Iterable, List, Set, Tuple

from .judge import Graph
from .listening_sockets import ListeningSocket, sockets_in

CALLER = "/graph_watch"
MASTER, ROSLAUNCH = "ROS master", "roslaunch"
PATIENCE_S = 3.0
SOCKET_NAME = re.compile(r"socket:\[(\d+)\]")


class CannotLook(Exception):
    """Master or system did not answer; the text states which and why."""


class _PatientTransport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = PATIENCE_S
        return connection


class Master:
    """Calls of the master's API with a time limit; CannotLook without a valid answer."""

    def __init__(self, uri: str):
        self.uri = uri
        self._proxy = xmlrpc.client.ServerProxy(uri, transport=_PatientTransport())

    def members(self) -> Dict[str, str]:
        """Return the URI of the master, of each roslaunch and node, by name; nodes that have just ended are omitted."""
        found = {MASTER: self.uri}
        for name in self._nodes():
            code, _, uri = self._call("lookupNode", name)
            if code == 1:
                found[name] = str(uri)
        launches = self.parameter("/roslaunch/uris")
        for number, uri in enumerate(sorted(launches.values()) if isinstance(launches, dict) else []):
            found[f"{ROSLAUNCH} {number + 1}"] = str(uri)
        return found

    def parameter(self, name: str) -> Any:
        """Return the value of a parameter; None without one."""
        code, _, value = self._call("getParam", name)
        return value if code == 1 else None

    def _nodes(self) -> List[str]:
        code, said, state = self._call("getSystemState")
        if code != 1:
            raise CannotLook(f"The ROS master does not tell its nodes: {said}.")
        return sorted({str(node) for kind in state for _, nodes in kind for node in nodes})

    def _call(self, method: str, *arguments: str) -> Tuple[int, str, Any]:
        try:
            code, said, value = getattr(self._proxy, method)(CALLER, *arguments)
        except (OSError, http.client.HTTPException, xmlrpc.client.Error, ValueError, TypeError) as error:
            raise CannotLook(f"The ROS master at {self.uri} does not answer {method}: {error}.") from error
        return int(code), str(said), value


def seen(master: Master, proc: pathlib.Path = pathlib.Path("/proc")) -> Graph:
    """Return the current graph; CannotLook. Nodes come first: a socket opened meanwhile is then found, a node at the
    next check."""
    members, link = master.members(), link_of(master.parameter("/dispatcher"))
    sockets = listening(proc)
    return Graph(members, sockets, owners_of({each.inode for each in sockets}, proc), link)


def link_of(parameters: Any) -> FrozenSet[Tuple[str, int]]:
    """Return the address of the Operator's link by the dispatcher's parameters; empty if they are missing."""
    said = parameters if isinstance(parameters, dict) else {}
    address, ports = said.get("bind_address"), (said.get("status_port"), said.get("command_port"))
    return frozenset((str(address), port) for port in ports if address and isinstance(port, int))


def listening(proc: pathlib.Path) -> List[ListeningSocket]:
    """Return the listening TCP sockets of this computer; a kernel without IPv6 has only one table."""
    try:
        found = sockets_in((proc / "net" / "tcp").read_text(encoding="ascii"))
        with contextlib.suppress(FileNotFoundError):
            found += sockets_in((proc / "net" / "tcp6").read_text(encoding="ascii"))
    except (OSError, ValueError) as error:
        raise CannotLook(f"The system does not tell its sockets: {error}.") from error
    return found


def owners_of(inodes: Set[int], proc: pathlib.Path) -> Dict[int, FrozenSet[int]]:
    """Return the processes that have these sockets open, as far as this user may see them."""
    found: Dict[int, Set[int]] = {}
    for process in proc.iterdir():
        if process.name.isdigit():
            for inode in inodes.intersection(_inodes_of(process / "fd")):
                found.setdefault(inode, set()).add(int(process.name))
    return {inode: frozenset(processes) for inode, processes in found.items()}


def _inodes_of(folder: pathlib.Path) -> Iterable[int]:
    # Processes and files may end during the search, and other users' may be unreadable.
    with contextlib.suppress(OSError):
        for name in os.listdir(folder):
            with contextlib.suppress(OSError):
                match = SOCKET_NAME.match(os.readlink(folder / name))
                if match:
                    yield int(match.group(1))
