"""Publishers and subscribers of a ROS graph that are not connected yet.

A message that is published before its subscriber is connected is lost, and the subscriber of a lock-step topic would
wait for it. Therefore the clock starts when the graph is complete.
"""
# SPDX-License-Identifier: Apache-2.0
import http.client
import threading
import time
import xmlrpc.client
from typing import Any, Callable, Iterable, List, NamedTuple, Set, Tuple

# Errors of a call to a node that has just ended.
CALL_ERRORS = (OSError, xmlrpc.client.Error, http.client.HTTPException)
# Topics of all nodes on which no tick depends.
IGNORED_TOPICS = ("/rosout", "/rosout_agg", "/diagnostics")
CHECK_EVERY_S = 0.05
LIMIT_S = 20.0


class Connection(NamedTuple):
    """Connection of a topic from one node to another."""

    topic: str
    publisher: str
    subscriber: str


def wanted(system_state: List[List[Tuple[str, List[str]]]]) -> Set[Connection]:
    """Return the connections that should exist, from the master's getSystemState."""
    publishers, subscribers = ({topic: nodes for topic, nodes in side} for side in system_state[:2])
    return {Connection(topic, source, sink) for topic in publishers.keys() & subscribers.keys()
            if topic not in IGNORED_TOPICS for source in publishers[topic] for sink in subscribers[topic]
            if source != sink}


def outgoing(node: str, bus_info: List[List[Any]]) -> Set[Connection]:
    """Return the connections that a node serves, from its getBusInfo."""
    return {Connection(entry[4], node, entry[1]) for entry in bus_info if entry[2] == "o"}


def missing(master_uri: str, caller: str) -> Set[Connection]:
    """Return the missing connections of the running graph; nodes that have ended without unregistering are ignored."""
    master: Any = xmlrpc.client.ServerProxy(master_uri)
    connections = wanted(master.getSystemState(caller)[2])
    alive: Set[str] = set()
    served: Set[Connection] = set()
    for node in {name for connection in connections for name in (connection.publisher, connection.subscriber)}:
        try:
            api: Any = xmlrpc.client.ServerProxy(master.lookupNode(caller, node)[2])
            served |= outgoing(node, api.getBusInfo(caller)[2])
        except CALL_ERRORS:
            continue
        alive.add(node)
    return {connection for connection in connections - served
            if connection.publisher in alive and connection.subscriber in alive}


def sentence(connections: Iterable[Connection]) -> str:
    """Describe missing connections for a person."""
    return ", ".join(f"{each.topic} from {each.publisher} to {each.subscriber}" for each in sorted(connections))


def wait_until_complete(master_uri: str, caller: str, stopped: threading.Event, warn: Callable[[str], None]) -> None:
    """Return when no connection is missing, when stopped, or after a time limit with a warning."""
    deadline = time.monotonic() + LIMIT_S
    while not stopped.wait(CHECK_EVERY_S):
        absent = missing(master_uri, caller)
        if not absent:
            return
        if time.monotonic() > deadline:
            warn(f"The clock starts without these connections: {sentence(absent)}.")
            return
