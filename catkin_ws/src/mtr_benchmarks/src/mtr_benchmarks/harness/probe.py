"""A process with a ROS name and a ROS master of its own, which measures one node on the machine's clock."""
# SPDX-License-Identifier: Apache-2.0
import os
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
    """Processor time that all threads of a process have used so far, user and system."""
    with open(f"/proc/{process}/stat", encoding="ascii") as line:
        fields = line.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * CLOCK_TICK_S
