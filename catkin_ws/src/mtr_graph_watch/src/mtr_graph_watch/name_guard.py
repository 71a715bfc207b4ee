"""Starts a node only while no other process runs under its name, e.g. of a second robot.launch on the same ROS master.

Used as launch-prefix. The master ends a node whose name is registered again, and roslaunch restarts it: two robots on
one master would end each other's nodes forever. The second one waits instead, and reports why.
"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import http.client
import os
import pathlib
import sys
import time
import xmlrpc.client
from typing import Any, List, Mapping, Optional, Sequence

from mtr_core import names

CALLER = "/name_guard"
NAME = "__name:="
PATIENCE_S, PERIOD_S = 1.0, 1.0
CALL_ERRORS = (OSError, http.client.HTTPException, xmlrpc.client.Error, ValueError, TypeError)
RUNS_ALREADY = ("The node {node} already runs on this ROS master (process {pid}): robot.launch was started twice. "
                "This start waits; end one of the two.")


class _PatientTransport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = PATIENCE_S
        return connection


def node_name(command: Sequence[str], environment: Mapping[str, str]) -> str:
    """Return the full name that roslaunch gives the node of a command; empty without one."""
    given = next((word[len(NAME):] for word in command if word.startswith(NAME)), "")
    namespace = environment.get("ROS_NAMESPACE", "").strip("/")
    return f"/{namespace}/{given}".replace("//", "/") if given else ""


def running_process(master: Any, node: str, proc: pathlib.Path = pathlib.Path("/proc")) -> Optional[int]:
    """Return the process that runs under the name; None if the registered one has died, or none is registered.

    The port may meanwhile belong to another process of this computer, whose command line then has another name.
    """
    code, _, uri = master.lookupNode(CALLER, node)
    if code != 1:
        return None
    try:
        _, _, pid = _proxy(uri).getPid(CALLER)
        words = (proc / str(pid) / "cmdline").read_bytes().split(b"\0")
    except CALL_ERRORS:
        return None
    return int(pid) if f"{NAME}{node.rpartition('/')[2]}".encode() in words else None


def wait_for_name(master: Any, node: str) -> None:
    """Return when no process runs under the name. Meanwhile the reason is printed once and stored for the Operator."""
    pid = running_process(master, node)
    if pid is None:
        return
    parameter, sentence = f"{names.START_FAILURES}{node}", RUNS_ALREADY.format(node=node, pid=pid)
    print(sentence, file=sys.stderr, flush=True)
    master.setParam(CALLER, parameter, sentence)
    try:
        while running_process(master, node) is not None:
            time.sleep(PERIOD_S)
    finally:
        # This also runs when roslaunch ends this start.
        master.deleteParam(CALLER, parameter)


def main(command: List[str]) -> None:
    """Replace this process by the command as soon as its node's name is free."""
    node = node_name(command, os.environ)
    if node:
        # A master that does not answer does not block the start: the node reports that itself.
        with contextlib.suppress(KeyError, *CALL_ERRORS):
            try:
                wait_for_name(_proxy(os.environ["ROS_MASTER_URI"]), node)
            except KeyboardInterrupt:
                sys.exit(0)
    os.execvp(command[0], command)


def _proxy(uri: str) -> Any:
    return xmlrpc.client.ServerProxy(uri, transport=_PatientTransport())


if __name__ == "__main__":
    main(sys.argv[1:])
