"""Runs a probe, a process with its own ROS master, which measures one node on the machine's clock."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
from typing import Dict, List

from mtr_simulation.stack import free_port

CLOCK_TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")


def run_probe(module: str, arguments: List[str], limit_s: float) -> Dict[str, List[float]]:
    """Run a module that prints lines `<name> <number>`; return the numbers by name.

    Raises:
        subprocess.CalledProcessError: the module failed; its stderr has the reason.
    """
    port = free_port()
    environment = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1")
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    try:
        done = subprocess.run([sys.executable, "-m", module, *arguments], env=environment, stdout=subprocess.PIPE,
                              text=True, check=True, timeout=limit_s)
    finally:
        master.terminate()
        master.wait()
    found: Dict[str, List[float]] = {}
    for words in (line.split() for line in done.stdout.splitlines()):
        if len(words) == 2:
            found.setdefault(words[0], []).append(float(words[1]))
    return found


def cpu_s(process: int) -> float:
    """Return the user and system time that a process and its descendants have used so far, s."""
    return _own_cpu_s(process) + sum(cpu_s(child) for child in _children(process))


def _own_cpu_s(process: int) -> float:
    with open(f"/proc/{process}/stat", encoding="ascii") as line:
        fields = line.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * CLOCK_TICK_S


def _children(process: int) -> List[int]:
    """Return the running child processes of all threads of a process."""
    lists = pathlib.Path(f"/proc/{process}/task").glob("*/children")
    return [int(child) for each in lists for child in each.read_text(encoding="ascii").split()]
