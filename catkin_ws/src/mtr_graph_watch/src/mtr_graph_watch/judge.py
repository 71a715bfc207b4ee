"""Detects parts of the ROS graph that are reachable from outside this computer. Pure."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, FrozenSet, Iterator, List, Mapping, Optional, Sequence, Tuple
from urllib.parse import urlsplit

from mtr_core.problems import NO_PROBLEM, Problem

from . import problems
from .listening_sockets import ListeningSocket, is_loopback

# Time without a complete check that is tolerated, because the master is busy while nodes start. Then the robot stops.
MAX_AGE_S = 10.0


@dataclass(frozen=True)
class Graph:
    """State of the graph, from the master and the system at one time.

    Attributes:
        members: URI of master, roslaunch and each node, by name.
        sockets: listening sockets of this computer.
        owners: ids of the processes that have a socket open, by its inode; only readable ones.
        link: address and port at which the Operator's link is intended to listen.
    """

    members: Mapping[str, str]
    sockets: Sequence[ListeningSocket]
    owners: Mapping[int, FrozenSet[int]]
    link: FrozenSet[Tuple[str, int]] = frozenset()


def openings(graph: Graph) -> List[Problem]:
    """Return a sentence for each access to the graph from outside, ordered by name."""
    found = sorted({*_announced(graph), *_listening(graph)})
    return [problems.GRAPH_OPEN(who=who, address=place) for who, place in found]


def _announced(graph: Graph) -> Iterator[Tuple[str, str]]:
    for who, uri in graph.members.items():
        host, port = place_of(uri)
        if not is_loopback(host):
            yield who, f"{host}:{port}"


def _listening(graph: Graph) -> Iterator[Tuple[str, str]]:
    by_port = {place_of(uri)[1]: who for who, uri in sorted(graph.members.items(), reverse=True)}
    by_process = _members_by_process(graph, by_port)
    for each in graph.sockets:
        if is_loopback(each.address) or (each.address, each.port) in graph.link:
            continue
        # A process of another user is known only by its port.
        names = [by_port.get(each.port, ""), *(by_process.get(owner, "") for owner in graph.owners.get(each.inode, ()))]
        who = next((name for name in names if name), "")
        if who:
            yield who, each.place


def _members_by_process(graph: Graph, by_port: Mapping[int, str]) -> Dict[int, str]:
    return {owner: by_port[each.port] for each in graph.sockets if each.port in by_port
            for owner in graph.owners.get(each.inode, ())}


def place_of(uri: str) -> Tuple[str, int]:
    """Return host and port of a URI; an empty host, which is not loopback, and port 0 if missing."""
    try:
        parts = urlsplit(uri)
        return parts.hostname or "", parts.port or 0
    except ValueError:
        return "", 0


class Verdict:
    """Result of the newest check, with its validity.

    Attributes:
        openings: sentences of the newest check.
    """

    def __init__(self, now_s: float):
        """now_s: on the steady clock, as in all methods."""
        self.openings: List[Problem] = []
        self._seen_s = now_s

    def saw(self, graph: Graph, now_s: float) -> None:
        """Add a complete check."""
        self.openings, self._seen_s = openings(graph), now_s

    def problem(self, now_s: float) -> Problem:
        """Return why the robot must not move; an opening counts until a check shows it closed."""
        age_s = now_s - self._seen_s
        first: Optional[Problem] = next(iter(self.openings), None)
        if first:
            return first
        return problems.GRAPH_UNSEEN(age_s=age_s, limit_s=MAX_AGE_S) if age_s > MAX_AGE_S else NO_PROBLEM
