"""Measures the delay that CURVE adds to a Command to the dispatcher, on loopback; figures go to link.json.

Usage: python -m mtr_benchmarks.link [--commands N] [--rounds N] [--out FOLDER]

Commands go alternately through two links, so that other load of the machine affects both equally.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import contextlib
import os
import pathlib
import subprocess
import sys
import threading
import time
from typing import Dict, Iterator, List, Optional

import zmq

from mtr_dispatcher.access.curve import Curve
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_proto.keys import KeyPair
from mtr_simulation.clock.machine import take_precedence
from mtr_simulation.stack import free_port

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row
from ..harness.tails import Turn, percentile, ratio_of
from .sender import STAMP

RATIO = Requirement("p99 of a Command's way on loopback, encrypted against plain", "(x)", must=1.5)
# Limits of the wait for one message and of a round, s.
QUIET_S, LIMIT_S = 1.0, 300.0
NOT_HURRIED = "This process had no priority over what else the machine did: that takes root."


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure both links; return 0 if the cost of encryption is within its limit."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--commands", type=int, default=500, help="of each link in a round, default %(default)s")
    parser.add_argument("--rounds", type=int, default=20, help="default %(default)s")
    options = parser.parse_args(arguments)
    # Same priority as the robot's service; set before any thread starts, because threads inherit it.
    remarks = [] if take_precedence() else [NOT_HURRIED]
    return finish(report([one_round(options.commands) for _ in range(options.rounds)], remarks),
                  options.out / "link.json")


def report(turns: List[Turn], remarks: List[str]) -> BenchmarkReport:
    """Return figures and table."""
    ratio = ratio_of(turns)
    figures = {"load": os.getloadavg()[0],
               "plain": _times([delay for turn in turns for delay in turn.without_s]),
               "encrypted": _times([delay for turn in turns for delay in turn.with_s])}
    row = Row(RATIO, ratio.value, details={"low_95": ratio.low, "high_95": ratio.high},
              remark=f"95 % {ratio.low:.2f} to {ratio.high:.2f}; {1e3 * ratio.with_s:.2f} and "
                     f"{1e3 * ratio.without_s:.2f} ms")
    return BenchmarkReport([row], figures, remarks)


def one_round(count: int) -> Turn:
    """Return the delays from sending to reception by the dispatcher's link server, for `count` Commands on each link,
    s."""
    robot, laptop = KeyPair(*zmq.curve_keypair()), KeyPair(*zmq.curve_keypair())
    known = laptop.public.decode("ascii")
    keys = [key.decode("ascii") for key in (*laptop, robot.public)]
    ports = free_port(), free_port()
    with _server(ports[0], None) as plain, _server(ports[1], Curve(robot, lambda key: key == known)) as encrypted:
        found: List[List[float]] = [[], []]
        takers = [threading.Thread(target=_take, args=(server, count, delays), daemon=True)
                  for server, delays in zip((plain, encrypted), found)]
        for taker in takers:
            taker.start()
        # The sender starts when both connections exist, so that no message is lost.
        subprocess.run([sys.executable, "-m", "mtr_benchmarks.link.sender", *map(str, ports), str(count), *keys],
                       check=True, timeout=LIMIT_S)
        for taker in takers:
            taker.join(LIMIT_S)
    return Turn(*found)


@contextlib.contextmanager
def _server(port: int, curve: Optional[Curve]) -> Iterator[LinkServer]:
    server = LinkServer(Ports("127.0.0.1", free_port(), port), curve)
    server.bind()
    try:
        yield server
    finally:
        server.close()


def _take(server: LinkServer, count: int, delays: List[float]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while len(delays) < count and time.monotonic() < end_s:
        messages, now_ns = server.receive(QUIET_S), time.monotonic_ns()
        delays += [1e-9 * (now_ns - STAMP.unpack_from(message.data)[0]) for message in messages]


def _times(values_s: List[float]) -> Dict[str, float]:
    return {"commands": len(values_s), **{f"p{percent}_ms": 1e3 * percentile(values_s, 0.01 * percent)
                                          for percent in (50, 90, 99)}}


if __name__ == "__main__":
    sys.exit(main())
