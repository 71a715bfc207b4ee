"""Detection of reachable parts of the ROS graph, with synthetic tables and this machine's own."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import socket
import subprocess
import sys
import threading
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

import pytest

from mtr_graph_watch import look
from mtr_graph_watch.environment import LIBRARY, as_around, closed_environment, join_on_loopback
from mtr_graph_watch.judge import MAX_AGE_S, Graph, Verdict, openings, place_of
from mtr_graph_watch.listening_sockets import ListeningSocket, is_loopback, sockets_in

HEADER = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
REST = "00000000:00000000 00:00000000 00000000     0        0"
# Format of a little-endian kernel; the third row is a connection, not a listener.
TCP = HEADER + (f"   0: 00000000:9FC3 00000000:0000 0A {REST} 4103776 1 00000000da2117b4 100 0 0 10 0\n"
                f"   1: 0100007F:2C2F 00000000:0000 0A {REST} 4103753 1 000000001b1b1b1b 100 0 0 10 0\n"
                f"   2: 020200C0:8000 0100007F:2C2F 01 {REST} 4103799 1 000000002c2c2c2c 100 0 0 10 0\n")
ZEROS = "0" * 32
TCP6 = HEADER + (f"   0: {ZEROS}:0D05 {ZEROS}:0000 0A {REST} 77 1 0000000000000000 100 0 0 10 0\n"
                 f"   1: {'0' * 16}FFFF00000100007F:0D06 {ZEROS}:0000 0A {REST} 78 1 0000000000000000 100 0 0 10 0\n")
OPEN = "0.0.0.0"
MASTER, NODE = 11311, 40899
MEMBERS = {"ROS master": f"http://127.0.0.1:{MASTER}/", "/drive_control": f"http://127.0.0.1:{NODE}/"}


def graph(*sockets, members=None, owners=None, link=()):
    """Return a graph of (address, port, inode)."""
    return Graph(MEMBERS if members is None else members, [ListeningSocket(*each) for each in sockets],
                 {inode: frozenset(found) for inode, found in (owners or {}).items()}, frozenset(link))


def told(looked):
    """Return the reachable members with their addresses."""
    return [(dict(each.arguments)["who"], dict(each.arguments)["address"]) for each in openings(looked)]


def test_tables_of_the_kernel_are_read():
    assert sockets_in(TCP) == [ListeningSocket(OPEN, 40899, 4103776), ListeningSocket("127.0.0.1", 11311, 4103753)]
    assert [(each.port, is_loopback(each.address)) for each in sockets_in(TCP6)] == [(3333, False), (3334, True)]
    assert sockets_in(TCP6)[0].place == "[::]:3333"
    with pytest.raises(ValueError):
        sockets_in(TCP.replace("00000000:9FC3", "nonsense:9FC3"))


@pytest.mark.parametrize("address, expected", [
    ("127.0.0.1", True), ("127.1.2.3", True), ("::1", True), ("::ffff:127.0.0.1", True), ("localhost", True),
    ("0.0.0.0", False), ("::", False), ("::ffff:192.0.2.2", False), ("192.168.1.9", False), ("robot", False),
    ("", False), ("localhost.example", False)])
def test_only_loopback_is_loopback(address, expected):
    assert is_loopback(address) is expected


def test_graph_on_loopback_is_closed_whatever_else_listens_on_this_computer():
    looked = graph(("127.0.0.1", MASTER, 1), ("::1", NODE, 2), (OPEN, 22, 3), ("192.0.2.2", 631, 4),
                   owners={1: {10}, 2: {20}, 3: {30}, 4: {40}})
    assert told(looked) == []


def test_server_of_a_node_that_says_loopback_and_listens_everywhere_is_found():
    # As roscpp with ROS_IP=127.0.0.1; for another user's process only the port is known.
    assert told(graph((OPEN, NODE, 2))) == [("/drive_control", f"0.0.0.0:{NODE}")]
    assert told(graph(("::", MASTER, 1))) == [("ROS master", f"[::]:{MASTER}")]


def test_further_socket_of_a_node_s_process_is_found():
    owners = {2: {20}, 5: {20}, 6: {21}}
    looked = graph(("127.0.0.1", NODE, 2), ("192.0.2.2", 50000, 5), (OPEN, 50001, 6), owners=owners)
    assert told(looked) == [("/drive_control", "192.0.2.2:50000")]


def test_link_may_listen_where_it_is_meant_to_and_nowhere_else():
    sockets = [("127.0.0.1", NODE, 2), ("10.42.0.1", 3333, 5), ("10.42.0.1", 3334, 6), (OPEN, 3333, 7)]
    looked = graph(*sockets, owners={inode: {20} for inode in (2, 5, 6, 7)},
                   link=[("10.42.0.1", 3333), ("10.42.0.1", 3334)])
    assert told(looked) == [("/drive_control", "0.0.0.0:3333")]


@pytest.mark.parametrize("uri, place", [
    ("http://192.0.2.7:4000/", "192.0.2.7:4000"), ("http://robot:4000", "robot:4000"), ("", ":0"),
    ("http://robot:nonsense/", ":0"), ("http://[::", ":0")])
def test_node_that_is_announced_elsewhere_is_found(uri, place):
    assert told(graph(members={**MEMBERS, "/rviz": uri})) == [("/rviz", place)]


def test_all_openings_are_told_once_each_and_say_what_to_do():
    looked = graph((OPEN, NODE, 2), (OPEN, NODE, 2), ("192.0.2.2", MASTER, 1))
    found = openings(looked)
    assert told(looked) == [("/drive_control", f"0.0.0.0:{NODE}"), ("ROS master", f"192.0.2.2:{MASTER}")]
    assert found[0].code == "bringup.graph_open" and "mtr_graph_watch closed" in found[0].text


def test_place_of_a_good_uri():
    assert place_of("http://127.0.0.1:11311/") == ("127.0.0.1", 11311)


def test_verdict_stands_until_a_look_shows_otherwise():
    verdict = Verdict(100.0)
    assert not verdict.problem(100.0)
    verdict.saw(graph((OPEN, NODE, 2)), 101.0)
    assert verdict.problem(101.0).code == "bringup.graph_open"
    # Without new information it counts as open.
    assert verdict.problem(101.0 + 2 * MAX_AGE_S).code == "bringup.graph_open"
    verdict.saw(graph(), 200.0)
    assert not verdict.problem(200.0 + MAX_AGE_S)


def test_robot_stands_when_nothing_was_seen_for_too_long():
    verdict = Verdict(100.0)
    assert not verdict.problem(100.0 + MAX_AGE_S)
    late = verdict.problem(101.0 + MAX_AGE_S)
    assert late.code == "bringup.graph_unseen" and "11 s" in late.text and "10 s" in late.text


def test_closed_environment_keeps_all_but_what_opens():
    given = {"PATH": "/bin", "ROS_HOSTNAME": "robot", "ROS_IP": "10.42.0.1", "ROS_MASTER_URI": "http://127.0.0.1:2"}
    closed = {"PATH": "/bin", "ROS_IP": "127.0.0.1", "ROS_MASTER_URI": "http://127.0.0.1:2", "LD_PRELOAD": LIBRARY}
    assert closed_environment(given) == closed and closed_environment({})["ROS_MASTER_URI"] == "http://127.0.0.1:11311"
    # A program that joins an open graph keeps its environment.
    assert as_around(given) == given and as_around({"ROS_IP": "127.0.0.1"})["LD_PRELOAD"] == LIBRARY


@pytest.mark.parametrize("given, address", [
    ({"ROS_MASTER_URI": "http://localhost:11311"}, "127.0.0.1"),
    ({"ROS_MASTER_URI": "http://127.0.0.1:1"}, "127.0.0.1"),
    ({"ROS_MASTER_URI": "http://10.0.0.1:11311"}, None), ({}, None),
    ({"ROS_MASTER_URI": "http://localhost:11311", "ROS_IP": "10.0.0.1"}, "10.0.0.1"),
    ({"ROS_MASTER_URI": "http://localhost:11311", "ROS_HOSTNAME": "robot"}, None)])
def test_program_that_joins_a_graph_on_loopback_listens_there_unless_a_person_chose(given, address):
    join_on_loopback(given)
    assert given.get("ROS_IP") == address


def test_program_closed_runs_another_in_that_environment():
    program = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "closed"

    def run(*words):
        return subprocess.run([sys.executable, str(program), *words], text=True, capture_output=True, check=False,
                              env=dict(os.environ, ROS_HOSTNAME="robot"))
    assert run("printenv", "ROS_IP").stdout == "127.0.0.1\n" and run("printenv", "ROS_HOSTNAME").stdout == ""
    assert run().returncode == 1 and "Say which program" in run().stderr
    assert "no-such-program cannot be run" in run("no-such-program").stderr


class Quiet(SimpleXMLRPCRequestHandler):
    """Request handler at the root, as the ROS master's, without a log."""

    rpc_paths = ("/", "/RPC2")

    def log_message(self, *_):
        """Suppress the log."""


class FakeMaster:
    """ROS master with one node, which has the same URI, and the given parameters."""

    def __init__(self, parameters=None, code=1):
        self.parameters, self.code = parameters or {}, code

    def getSystemState(self, _):
        """Return publishers, subscribers, services."""
        return self.code, "said", [[["/topic", ["/node", "/gone"]]], [], [["/service", ["/node"]]]]

    def lookupNode(self, _, name):
        """Return the URI of the existing node."""
        return (1, "", f"http://127.0.0.1:{self.port}/") if name == "/node" else (-1, "unknown node", "")

    def getParam(self, _, name):
        """Return one of the parameters."""
        return (1, "", self.parameters[name]) if name in self.parameters else (-1, "not set", 0)

    @contextlib.contextmanager
    def serve(self, address="127.0.0.1"):
        """Return the master's interface while it answers on this address."""
        with SimpleXMLRPCServer((address, 0), Quiet, allow_none=True) as server:
            self.port = server.server_address[1]
            server.register_instance(self)
            thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
            thread.start()
            try:
                yield look.Master(f"http://127.0.0.1:{self.port}")
            finally:
                server.shutdown()
                thread.join()


def test_this_machine_s_own_sockets_are_seen():
    parameters = {"/roslaunch/uris": {"host_a__1": "http://127.0.0.1:1/"}}
    with FakeMaster(parameters).serve() as master, socket.socket() as exposed:
        closed = look.seen(master)
        assert set(closed.members) == {"ROS master", "/node", "roslaunch 1"} and openings(closed) == []
        exposed.bind((OPEN, 0))
        exposed.listen()
        looked = look.seen(master)
    assert [place for _, place in told(looked)] == [f"0.0.0.0:{exposed_port(looked)}"]


def exposed_port(looked):
    """Return the port of this process's socket on every address."""
    return next(each.port for each in looked.sockets if each.address == OPEN
                and os.getpid() in looked.owners.get(each.inode, ()))


def test_master_that_listens_everywhere_is_found():
    with FakeMaster().serve(OPEN) as master:
        assert openings(look.seen(master))


def test_master_without_a_good_answer_is_said(monkeypatch):
    with FakeMaster(code=0).serve() as master, pytest.raises(look.CannotLook, match="said"):
        look.seen(master)
    with pytest.raises(look.CannotLook, match="does not answer getSystemState"):
        look.seen(look.Master("http://127.0.0.1:1"))
    monkeypatch.setattr(look, "PATIENCE_S", 0.05)
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        with pytest.raises(look.CannotLook, match="timed out"):
            look.seen(look.Master(f"http://127.0.0.1:{silent.getsockname()[1]}"))


def test_system_without_its_tables_is_said(tmp_path):
    with pytest.raises(look.CannotLook, match="does not tell its sockets"):
        look.listening(tmp_path)
    (tmp_path / "net").mkdir()
    (tmp_path / "net" / "tcp").write_text(TCP, encoding="ascii")
    assert len(look.listening(tmp_path)) == 2


@pytest.mark.parametrize("parameters, expected", [
    ({"bind_address": "10.42.0.1", "status_port": 3334, "command_port": 3333},
     {("10.42.0.1", 3333), ("10.42.0.1", 3334)}),
    (None, set()), ("nonsense", set()), ({"bind_address": "10.42.0.1", "status_port": "x"}, set())])
def test_place_of_the_link_by_the_dispatcher_s_parameters(parameters, expected):
    assert look.link_of(parameters) == expected


def test_process_that_may_not_be_read_owns_nothing(tmp_path):
    for name in ("1", "2", "self"):
        (tmp_path / name / "fd").mkdir(parents=True)
        (tmp_path / name / "fd" / "3").symlink_to("socket:[99]")
    pathlib.Path(tmp_path / "2" / "fd").rename(tmp_path / "2" / "gone")
    assert look.owners_of({99}, tmp_path) == {99: frozenset({1})}
