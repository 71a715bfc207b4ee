"""A server in its own process does not affect the application, even if it stops or is killed."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys

import pytest
from followed_tests import Measuring
from live_browser import PATIENCE_S, Browser, ask, only_name

from mtr_operator.cli import main as operator_main

DEMO = pathlib.Path(__file__).resolve().parents[3] / "examples" / "demo"


@contextlib.contextmanager
def served(folder, store, port=0):
    """Start a server process; yield the process and its port."""
    command = [sys.executable, "-m", "mtr_results", "serve", "--json", "--follow", str(folder), "--store", str(store),
               "--port", str(port)]
    # Remove unbuffered output from the environment: the server itself must flush its address.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        try:
            text = ""
            while not text.rstrip().endswith("}"):
                line = process.stdout.readline()
                assert line, "the server has ended"
                text += line
            yield process, int(json.loads(text)["address"].rsplit(":", 1)[1].strip("/"))
        finally:
            process.kill()


def results_of(folder):
    text = (folder / "results.csv").read_text(encoding="utf-8")
    return [line for line in text.splitlines() if not line.startswith("# started")]


def measure(folder):
    arguments = ["run", "key_press", "--params", str(DEMO / "key_press.yaml"), "--out", str(folder), "--seed", "5",
                 "--simulated-robot", "--simulated-car"]
    assert operator_main(arguments) == 0


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="nothing stops a process here")
def test_a_server_that_stands_is_gone_or_comes_back_changes_nothing_of_a_test(tmp_path):
    measure(tmp_path / "alone")
    tests = tmp_path / "tests"
    tests.mkdir()
    with served(tests, tmp_path / "store.sqlite") as (process, port), Measuring(tests / "other") as other:
        other.begin(1, 5.0)
        other.press(3.0, True)
        browser = Browser(port, only_name(port)).see("1 point,")
        os.kill(process.pid, signal.SIGSTOP)
        # Each call returns only when its data is on disk, regardless of the server.
        measure(tests / "stopped")
        other.press(4.9, True)
        os.kill(process.pid, signal.SIGCONT)
        browser.see("2 points")
        process.kill()
        process.wait(PATIENCE_S)
        other.press(5.4, False)
        measure(tests / "gone")
        with served(tests, tmp_path / "store.sqlite", port):
            name, = re.findall(r'href="/live/(\w+)">[^<]*other<', ask(port, "/live")[1])
            Browser(port, name).see("3 points")
    assert results_of(tests / "stopped") == results_of(tests / "gone") == results_of(tmp_path / "alone")
