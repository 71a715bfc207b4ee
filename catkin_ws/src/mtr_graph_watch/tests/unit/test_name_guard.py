"""A node waits while another process runs under its name, and starts when that one has ended."""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import subprocess
import sys
import threading
from types import SimpleNamespace
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from mtr_core import names
from mtr_graph_watch import name_guard

NODE, PID = "/dispatcher", 77


@pytest.mark.parametrize("command, environment, name", [
    (("node", "__name:=dispatcher", "__log:=x"), {}, "/dispatcher"),
    (("node", "--x", "__name:=joy"), {"ROS_NAMESPACE": "/"}, "/joy"),
    (("node", "__name:=joy"), {"ROS_NAMESPACE": "/bluetooth"}, "/bluetooth/joy"), (("node",), {}, "")])
def test_name_is_that_which_roslaunch_gives(command, environment, name):
    assert name_guard.node_name(command, environment) == name


def silent(_):
    """Node that does not answer."""
    raise OSError("Connection refused")


def master(code=1, **parameters):
    """Return a master with one registered node, which stores parameters."""
    kept = parameters
    return SimpleNamespace(lookupNode=lambda *_: (code, "", "http://127.0.0.1:1"), kept=kept,
                           setParam=lambda _, name, value: kept.__setitem__(name, value),
                           deleteParam=lambda _, name: kept.pop(name))


@pytest.fixture
def process(tmp_path, monkeypatch):
    """Make a process with this command line answer for the registered node; None for no process."""
    def answer(words, get_pid=lambda _: (1, "", PID)):
        monkeypatch.setattr(name_guard, "_proxy", lambda _: SimpleNamespace(getPid=get_pid))
        if words is not None:
            (tmp_path / str(PID)).mkdir(exist_ok=True)
            (tmp_path / str(PID) / "cmdline").write_bytes(b"\0".join(words))
        return tmp_path
    return answer


@pytest.mark.parametrize("code, words, get_pid, pid", [
    (1, [b"python3", b"node", b"__name:=dispatcher"], None, PID),
    # Not registered; died without notice; its port belongs to another node, or to a process that has ended.
    (-1, [b"node", b"__name:=dispatcher"], None, None), (1, [b"node", b"__name:=dispatcher"], silent, None),
    (1, [b"node", b"__name:=localization"], None, None), (1, None, None, None)])
def test_only_a_process_that_answers_and_bears_the_name_counts(process, code, words, get_pid, pid):
    proc = process(words, **({"get_pid": get_pid} if get_pid else {}))
    assert name_guard.running_process(master(code), NODE, proc) == pid


def test_node_waits_tells_why_once_and_starts_when_the_name_is_free(monkeypatch, capsys):
    answers, kept, told = iter([PID, PID, PID, PID, None]), master(), []
    monkeypatch.setattr(name_guard, "running_process", lambda *_: next(answers))
    monkeypatch.setattr(name_guard.time, "sleep", lambda _: told.append(dict(kept.kept)))
    name_guard.wait_for_name(kept, NODE)
    sentence = capsys.readouterr().err
    assert sentence.count("robot.launch was started twice") == 1 and f"process {PID}" in sentence
    # The dispatcher shows these to the Operator.
    assert told == [{f"{names.START_FAILURES}{NODE}": sentence.strip()}] * 3 and kept.kept == {}


def test_free_name_starts_at_once_and_leaves_what_the_node_reported_itself(monkeypatch):
    kept = master(**{f"{names.START_FAILURES}{NODE}": "It cannot start."})
    monkeypatch.setattr(name_guard, "running_process", lambda *_: None)
    name_guard.wait_for_name(kept, NODE)
    assert list(kept.kept) == [f"{names.START_FAILURES}{NODE}"]


@pytest.fixture
def server():
    """Run a master, and a node of the name dispatcher whose process is `holder`."""
    made = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False, allow_none=True)
    made.uri = f"http://127.0.0.1:{made.server_address[1]}"
    made.pid, made.told = 0, threading.Event()
    made.register_function(lambda *_: (1, "", made.uri), "lookupNode")
    made.register_function(lambda _: (1, "", made.pid), "getPid")
    made.register_function(lambda *_: made.told.set() or (1, "", 0), "setParam")
    made.register_function(lambda *_: (1, "", 0), "deleteParam")
    threading.Thread(target=made.serve_forever, daemon=True).start()
    yield made
    made.shutdown()
    made.server_close()


def test_program_becomes_the_node_when_the_other_one_has_ended(server):
    with subprocess.Popen([sys.executable, "-c", "input()", "__name:=dispatcher"], stdin=subprocess.PIPE) as holder:
        server.pid = holder.pid
        program = [sys.executable, "-m", "mtr_graph_watch.name_guard", "echo", "started", "__name:=dispatcher"]
        with subprocess.Popen(program, env=dict(os.environ, ROS_MASTER_URI=server.uri), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as second:
            assert server.told.wait(30.0) and second.poll() is None
            holder.communicate(b"\n")
            out, err = second.communicate(timeout=30.0)
    assert out == "started __name:=dispatcher\n" and second.returncode == 0
    assert re.search(r"already runs on this ROS master \(process \d+\)", err)


def test_master_that_does_not_answer_delays_no_node():
    program = [sys.executable, "-m", "mtr_graph_watch.name_guard", "echo", "__name:=dispatcher"]
    done = subprocess.run(program, env=dict(os.environ, ROS_MASTER_URI="http://127.0.0.1:9"), text=True,
                          capture_output=True, timeout=30.0, check=True)
    assert done.stdout == "__name:=dispatcher\n"
