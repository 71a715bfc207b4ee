"""Looks at the graph: the ROS master's word, and the system's sockets."""
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
    """Master or system did not answer; the text says which and why."""


class _PatientTransport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = PATIENCE_S
        return connection


class Master:
    """Calls of the master's API, each bounded in time; CannotLook when there is no good answer."""

    def __init__(self, uri: str):
        self.uri = uri
        self._proxy = xmlrpc.client.ServerProxy(uri, transport=_PatientTransport())

    def members(self) -> Dict[str, str]:
        """URI of the master, of each roslaunch and node, by name; a node that has just gone is left out."""
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
        """Its value; None when there is none."""
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
    """The graph as it is now; CannotLook. Nodes first: a socket opened meanwhile is then found, a node next time."""
    members, link = master.members(), link_of(master.parameter("/dispatcher"))
    sockets = listening(proc)
    return Graph(members, sockets, owners_of({each.inode for each in sockets}, proc), link)


def link_of(parameters: Any) -> FrozenSet[Tuple[str, int]]:
    """Where the Operator's link listens by the dispatcher's parameters; nowhere when they do not say."""
    said = parameters if isinstance(parameters, dict) else {}
    address, ports = said.get("bind_address"), (said.get("status_port"), said.get("command_port"))
    return frozenset((str(address), port) for port in ports if address and isinstance(port, int))


def listening(proc: pathlib.Path) -> List[ListeningSocket]:
    """TCP sockets of this computer that listen; a kernel without IPv6 has only one table."""
    try:
        found = sockets_in((proc / "net" / "tcp").read_text(encoding="ascii"))
        with contextlib.suppress(FileNotFoundError):
            found += sockets_in((proc / "net" / "tcp6").read_text(encoding="ascii"))
    except (OSError, ValueError) as error:
        raise CannotLook(f"The system does not tell its sockets: {error}.") from error
    return found


def owners_of(inodes: Set[int], proc: pathlib.Path) -> Dict[int, FrozenSet[int]]:
    """Processes that have these sockets open, as far as this user may see."""
    found: Dict[int, Set[int]] = {}
    for process in proc.iterdir():
        if process.name.isdigit():
            for inode in inodes.intersection(_inodes_of(process / "fd")):
                found.setdefault(inode, set()).add(int(process.name))
    return {inode: frozenset(processes) for inode, processes in found.items()}


def _inodes_of(folder: pathlib.Path) -> Iterable[int]:
    # Processes and files end while they are looked at, and those of another user may not be read.
    with contextlib.suppress(OSError):
        for name in os.listdir(folder):
            with contextlib.suppress(OSError):
                match = SOCKET_NAME.match(os.readlink(folder / name))
                if match:
                    yield int(match.group(1))
