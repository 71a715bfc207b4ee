"""One mutant against the tests: in a copy of this process, with a copy of the sources."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shutil
import signal
import sys
import time
from typing import List

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
TREES = TOP / "out" / "mutants" / "trees"
# Within it the tests without a mutant have to end, on whatever machine.
LIMIT_S = 600.0
POLL_S = 0.02
# The tests' libraries are imported once: each mutant's process is a copy of one that has them.
PRELOADED = ("numpy", "hypothesis", "google.protobuf", "genpy", "rospy", "mtr_msgs.msg", "mtr_proto.robot_link_pb2",
             "mtr_core.parameters", "mtr_core.conversions", "PyQt5.QtCore")


def prepare(source: pathlib.Path) -> None:
    """In a worker: a copy of the sources, which goes before the real ones."""
    for name in PRELOADED:
        __import__(name)
    tree = tree_of_this_process()
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(source, tree, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    sys.path.insert(0, str(tree))


def tree_of_this_process() -> pathlib.Path:
    """Where its copy of the sources lies."""
    return TREES / str(os.getpid())


def is_noticed(module: str, code: str, tests: List[str], limit_s: float) -> bool:
    """True when the tests fail with this text of the module, or do not end within limit_s."""
    path = tree_of_this_process() / module
    original = path.read_text(encoding="utf-8")
    path.write_text(code, encoding="utf-8")
    try:
        return not _passes(tests, limit_s)
    finally:
        path.write_text(original, encoding="utf-8")


def _passes(tests: List[str], limit_s: float) -> bool:
    child = os.fork()
    if not child:
        os.setsid()
        os._exit(_run(tests))
    deadline = time.monotonic() + limit_s
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0
        time.sleep(POLL_S)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return False


def _run(tests: List[str]) -> int:
    """pytest's exit status; it says nothing."""
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    sys.dont_write_bytecode = True
    # Its plugins take longer to load than most tests to run.
    os.environ.update(PYTEST_DISABLE_PLUGIN_AUTOLOAD="1", QT_QPA_PLATFORM="offscreen")
    return int(pytest.main(["-x", "-q", f"--rootdir={TOP}", *(str(TOP / test) for test in tests)]))
