"""What CURVE costs a Command on its way to the dispatcher, on loopback; figures go to link.json.

Usage: python -m mtr_benchmarks.link [--commands N] [--rounds N] [--out FOLDER]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import struct
import subprocess
import sys
import time
from typing import Dict, List, Optional

import zmq

from mtr_bringup.stack import free_port
from mtr_dispatcher.access.curve import Curve
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_proto.keys import KeyPair

from ..harness.report import BenchmarkReport, finish
from ..harness.rows import Requirement, Row

RATIO = Requirement("p99 of a Command's way on loopback, encrypted against plain", "(x)", must=1.5)
PLAIN, ENCRYPTED = "plain", "encrypted"
# As long as a Command with a waypoint and a press; what it begins with is when it was sent.
COMMAND_BYTES, STAMP = 120, struct.Struct("<q")
# Twice as often as an application sends at most, s.
RHYTHM_S = 0.005
# Of a round, without which the two do not see the same machine; s.
LIMIT_S = 300.0
SENDER = """
import struct, sys, time, zmq
port, count, size = map(int, sys.argv[1:4])
rhythm_s, keys = float(sys.argv[4]), sys.argv[5:]
socket = zmq.Context().socket(zmq.PUB)
if keys:
    socket.curve_publickey, socket.curve_secretkey, socket.curve_serverkey = (key.encode() for key in keys)
socket.connect(f"tcp://127.0.0.1:{port}")
sys.stdin.readline()
for _ in range(count):
    socket.send(struct.pack("<q", time.monotonic_ns()).ljust(size, b"x"))
    time.sleep(rhythm_s)
sys.stdin.read()
"""


def main(arguments: Optional[List[str]] = None) -> int:
    """Measure both in turn; the exit status says whether encryption costs little enough."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="folder of the figures")
    parser.add_argument("--commands", type=int, default=1000, help="of a round, default %(default)s")
    parser.add_argument("--rounds", type=int, default=6, help="of each kind, default %(default)s")
    options = parser.parse_args(arguments)
    found: Dict[str, List[float]] = {PLAIN: [], ENCRYPTED: []}
    for _ in range(options.rounds):
        for kind in (PLAIN, ENCRYPTED):
            found[kind] += one_round(kind == ENCRYPTED, options.commands)
    return finish(report(found), options.out / "link.json")


def report(delays_s: Dict[str, List[float]]) -> BenchmarkReport:
    """Figures and table."""
    figures = {kind: {"commands": len(values), **{f"p{percent}_ms": 1e3 * _percentile(values, percent)
                                                  for percent in (50, 90, 99)}} for kind, values in delays_s.items()}
    ratio = _percentile(delays_s[ENCRYPTED], 99) / _percentile(delays_s[PLAIN], 99)
    remark = ", ".join(f"{kind} {each['p99_ms']:.2f} ms" for kind, each in figures.items())
    return BenchmarkReport([Row(RATIO, ratio, remark=remark)], figures)


def one_round(is_encrypted: bool, count: int) -> List[float]:
    """From send to the dispatcher's hands, s, of so many Commands."""
    robot, laptop, port = KeyPair(*zmq.curve_keypair()), KeyPair(*zmq.curve_keypair()), free_port()
    known = laptop.public.decode("ascii")
    server = LinkServer(Ports("127.0.0.1", free_port(), port),
                        Curve(robot, lambda key: key == known) if is_encrypted else None)
    server.bind()
    keys = [key.decode("ascii") for key in (*laptop, robot.public)] if is_encrypted else []
    sender = subprocess.Popen([sys.executable, "-c", SENDER, str(port), str(count), str(COMMAND_BYTES), str(RHYTHM_S),
                               *keys], stdin=subprocess.PIPE)
    try:
        return _received(server, sender, count)
    finally:
        sender.kill()
        sender.wait()
        server.close()


def _received(server: LinkServer, sender: "subprocess.Popen[bytes]", count: int) -> List[float]:
    """What has come of so many; those before the connection stood are lost, as ZeroMQ's publishers lose them."""
    assert sender.stdin is not None
    sender.stdin.write(b"\n")
    sender.stdin.flush()
    found: List[float] = []
    end_s, quiet_s = time.monotonic() + LIMIT_S, 1.0
    while len(found) < count and time.monotonic() < end_s:
        messages, now_ns = server.receive(quiet_s), time.monotonic_ns()
        if found and not messages:
            break
        found += [1e-9 * (now_ns - STAMP.unpack_from(message.data)[0]) for message in messages]
    return found


def _percentile(values: List[float], percent: int) -> float:
    return sorted(values)[min(len(values) * percent // 100, len(values) - 1)]


if __name__ == "__main__":
    sys.exit(main())
