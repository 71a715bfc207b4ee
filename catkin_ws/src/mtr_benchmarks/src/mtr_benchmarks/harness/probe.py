"""A process with a ROS name and a ROS master of its own, which measures one node on the machine's clock."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
from typing import Dict, List

from mtr_bringup.stack import free_port

CLOCK_TICK_S = 1.0 / os.sysconf("SC_CLK_TCK")


def run_probe(module: str, arguments: List[str], limit_s: float) -> Dict[str, List[float]]:
    """Run a module that prints lines `<name> <number>`; the numbers by name.

    Raises:
        subprocess.CalledProcessError: it did not get to its end; it said why on stderr.
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
    """Processor time that all threads of a process, and of those that it has started, have used so far, user and
    system."""
    return _own_cpu_s(process) + sum(cpu_s(child) for child in _children(process))


def _own_cpu_s(process: int) -> float:
    with open(f"/proc/{process}/stat", encoding="ascii") as line:
        fields = line.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * CLOCK_TICK_S


def _children(process: int) -> List[int]:
    """Processes that run; a thread of this one may have started them."""
    lists = pathlib.Path(f"/proc/{process}/task").glob("*/children")
    return [int(child) for each in lists for child in each.read_text(encoding="ascii").split()]
