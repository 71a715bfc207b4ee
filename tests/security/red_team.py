"""Attacks a robot from the network until its standard input ends; prints what it has tried, as JSON.

Usage: red_team.py ADDRESS [--status-port N] [--command-port N] [--pairing-port N] [--robot-key KEY] [--keys FILE]
                   [--recording FILE] ATTACK...

A robot on which this moves anything has a hole. Attacks are those of attacks.py; without one all that need no key.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import json
import os
import pathlib
import sys
import threading
from typing import Counter, Dict

import zmq
from attacks import ALL, STRANGERS
from hostile_peer import Target

LEAST_URGENT = 19


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("address")
    parser.add_argument("attacks", nargs="*", metavar="ATTACK", help=", ".join(ALL))
    parser.add_argument("--status-port", type=int, default=3334)
    parser.add_argument("--command-port", type=int, default=3333)
    parser.add_argument("--pairing-port", type=int, default=0, help="of a pairing that somebody has begun")
    parser.add_argument("--robot-key", help="its public key, Z85; default: any")
    parser.add_argument("--keys", type=pathlib.Path, help="JSON: viewer and revoked, each a public and a secret key")
    parser.add_argument("--recording", type=pathlib.Path, help="bytes that a laptop has sent to the port of Commands")
    options = parser.parse_args()
    unknown = set(options.attacks) - set(ALL)
    if unknown:
        parser.error(f"There is no attack {min(unknown)}; there are: {', '.join(ALL)}.")
    robot_key = options.robot_key.encode("ascii") if options.robot_key else zmq.curve_keypair()[0]
    keys = json.loads(options.keys.read_text(encoding="ascii")) if options.keys else {}
    target = Target(options.address, options.status_port, options.command_port, options.pairing_port, robot_key,
                    {name: (public.encode("ascii"), secret.encode("ascii")) for name, (public, secret) in keys.items()},
                    options.recording.read_bytes() if options.recording else b"")
    names = options.attacks or [each.__name__ for each in STRANGERS if target.recording or each.__name__ != "replay"]
    # Whoever attacks has a computer of his own; where it is the robot's, that goes on first.
    os.nice(LEAST_URGENT)
    over = threading.Event()
    tries: Dict[str, Counter[str]] = {name: collections.Counter() for name in names}
    threads = [threading.Thread(target=ALL[name], args=(target, tries[name], over.is_set)) for name in names]
    for thread in threads:
        thread.start()
    sys.stdin.read()
    over.set()
    for thread in threads:
        thread.join()
    print(json.dumps(tries))
    return 0


if __name__ == "__main__":
    sys.exit(main())
