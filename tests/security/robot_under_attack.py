"""A running robot on an encrypted link that is attacked while its wheels are watched and its Operator commands."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import json
import os
import pathlib
import socket
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from typing import Any, Counter, Dict, List, Sequence

import zmq
from paired_operator import LIMIT_S, Operator

from mtr_benchmarks.soak.processes import below
from mtr_core import names
from mtr_dispatcher.access.authorised_keys import Entry, Role
from mtr_dispatcher.access.key_folder import KeyFolder
from mtr_proto import robot_link_pb2 as link
from mtr_simulation.stack import Stack, StackOptions

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
# Of the robot as of its service (setup/robot/mtr-robot.service), and of the Operator, who has a computer of his own:
# what else the machine does comes after both, with an attack and without one.
URGENT = -10
# One line for each word to wheels and buttons; what wheels are told is zero or it is motion.
WATCH = """
import rospy, sys
from geometry_msgs.msg import Twist
from mtr_msgs.msg import FirmwarePress
rospy.init_node("witness", anonymous=True)
def wheels(twist):
    moves = any((twist.linear.x, twist.linear.y, twist.angular.z))
    print("moves" if moves else "stands", flush=True)
rospy.Subscriber(sys.argv[1], Twist, wheels, queue_size=200, tcp_nodelay=True)
rospy.Subscriber(sys.argv[2], FirmwarePress, lambda _: print("press", flush=True), queue_size=200)
rospy.spin()
"""


class Witness:
    """What wheels and buttons are told. counts: words `moves`, `stands`, `press`."""

    def __init__(self, stack: Stack):
        self.counts: Counter[str] = Counter()
        self._process = subprocess.Popen([sys.executable, "-c", WATCH, names.WHEEL_COMMAND, names.FIRMWARE_PRESS],
                                         env=stack.environment(), text=True, stdout=subprocess.PIPE)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        for line in self._process.stdout:
            self.counts[line.strip()] += 1

    def close(self) -> None:
        """Look away."""
        self._process.kill()
        self._process.wait()
        self._thread.join()


class Recorder:
    """A relay of one port that somebody in the network has slipped in. said: what the laptop has sent."""

    def __init__(self, port: int):
        self._robot_port, self.said = port, b""
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        with contextlib.suppress(OSError):
            near, _ = self._listener.accept()
            far = socket.create_connection(("127.0.0.1", self._robot_port))
            threading.Thread(target=self._pass_on, args=(far, near, False), daemon=True).start()
            self._pass_on(near, far, True)

    def _pass_on(self, source: socket.socket, target: socket.socket, is_kept: bool) -> None:
        with contextlib.suppress(OSError), source, target:
            while True:
                data = source.recv(65536)
                if not data:
                    return
                self.said += data if is_kept else b""
                target.sendall(data)

    def close(self) -> None:
        """Take no more connections."""
        self._listener.close()


@dataclass
class Outcome:
    """What a group of attacks has done.

    Attributes:
        tries: of each attack, by what it tried.
        words: to wheels and buttons while it lasted.
        delays_s: of the Operator's Commands during it.
        notices: largest number of notifications of one code in one Status.
        codes: of all notifications that came meanwhile.
        log_lines: warnings of the dispatcher that reached the Operator.
    """

    tries: Dict[str, Dict[str, int]]
    words: Counter[str]
    delays_s: List[float]
    notices: int = 0
    codes: List[str] = field(default_factory=list)
    log_lines: int = 0


class RobotUnderAttack:
    """Use as a context manager. On the machine's clock, as a robot; paired: `Jana`, `Karel`, the viewer `Eva`."""

    def __init__(self, folder: pathlib.Path):
        # Nodes work in another folder.
        self.folder = folder = folder.resolve()
        self.keys = KeyFolder(folder / "keys")
        self.stack = Stack(StackOptions(folder, real_time_factor=1.0, lockstep_operator=False, arguments={
            "machine_clock": "true", "scenario": "lot", "encrypt_on_loopback": "true",
            "key_folder": str(folder / "keys")}))
        self._open = contextlib.ExitStack()

    def __enter__(self) -> "RobotUnderAttack":
        with contextlib.ExitStack() as opened:
            self.jana = self.paired("Jana", Role.CONTROLLER)
            viewer, revoked = self.paired("Eva", Role.VIEWER), self.paired("Petr", Role.CONTROLLER)
            self.keys.change(lambda known: known.without("Petr"))
            known = {"viewer": viewer, "revoked": revoked, "controller": self.paired("Karel", Role.CONTROLLER)}
            (self.folder / "known.json").write_text(json.dumps(
                {name: [each.decode("ascii") for each in pair] for name, pair in known.items()}), encoding="ascii")
            opened.enter_context(self.stack)
            self.witness = Witness(self.stack)
            opened.callback(self.witness.close)
            self._record()
            self.operator = self._operator(self.stack.status_port, self.stack.command_port)
            opened.callback(self.operator.close)
            self._open = opened.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def paired(self, name: str, role: Role) -> Any:
        """A new pair of keys that the robot knows."""
        keys = zmq.curve_keypair()
        self.keys.change(lambda known: known.with_entry(Entry(name, role, "2026-11-23", keys[0].decode())))
        return keys

    def _operator(self, *ports: int) -> Operator:
        return Operator(ports, self.jana, self.keys.own_keys().public)

    def _record(self) -> None:
        """The Operator drives the robot once, and somebody listens: what he would have to bring about himself."""
        recorder = Recorder(self.stack.command_port)
        operator = self._operator(self.stack.status_port, recorder.port)
        try:
            operator.until(lambda: operator.seen and operator.seen[-1].mode == link.MODE_READY_TO_MAP_CAR,
                           "readiness", stop=True)
            operator.until(lambda: self.witness.counts["moves"], "a drive of the paired Operator", map_car_id=1)
            operator.until(lambda: abs(operator.seen[-1].state.speed) < 0.01 and self.stands(), "standstill", stop=True)
            operator.end_session()
            operator.look(0.5)
        finally:
            operator.close()
            recorder.close()
        (self.folder / "recording").write_bytes(recorder.said)

    def stands(self) -> bool:
        """True when the wheels are told nothing but zero for a while."""
        before = self.witness.counts["stands"], self.witness.counts["moves"]
        time.sleep(0.5)
        return self.witness.counts["stands"] > before[0] and self.witness.counts["moves"] == before[1]

    def hurry(self) -> bool:
        """Let robot and Operator go before all else on this machine; False when that is not allowed."""
        try:
            for process in (os.getpid(), *below(self.stack.pid)):
                # Of threads, for the system has none of a process.
                for thread in pathlib.Path(f"/proc/{process}/task").iterdir():
                    os.setpriority(os.PRIO_PROCESS, int(thread.name), URGENT)
        except PermissionError:
            return False
        return True

    def quiet_delays_s(self, count: int) -> List[float]:
        """The Operator's Commands while nobody attacks."""
        found = [self.operator.delay_s() for _ in range(count)]
        self._end_session()
        return found

    def attacked(self, attacks: Sequence[str], idle_s: float, count: int, pairing_port: int = 0,
                 address: str = "127.0.0.1") -> Outcome:
        """Let attacks go on: first while nobody controls the robot, then while the Operator's Commands are timed."""
        before, seen = Counter(self.witness.counts), len(self.operator.seen)
        logged = {each.id for status in self.operator.seen for each in status.log}
        with self.attackers(attacks, pairing_port, address) as process:
            self.operator.look(idle_s)
            delays_s = [self.operator.delay_s() for _ in range(count)]
            self._end_session()
            tries = json.loads(process.communicate(timeout=LIMIT_S)[0])
        statuses = self.operator.seen[seen:]
        codes = [Counter(notice.code for notice in status.notifications) for status in statuses]
        lines = {each.id for status in statuses for each in status.log if "dispatcher" in each.source} - logged
        return Outcome(tries, self.witness.counts - before, delays_s,
                       max((max(each.values(), default=0) for each in codes), default=0),
                       sorted(set().union(*codes)), len(lines))

    def words_to_controller(self) -> Counter[str]:
        """Words to wheels and buttons when the attacks' orders have a controller's key: what the witness must see."""
        before = Counter(self.witness.counts)
        end_s = time.monotonic() + LIMIT_S
        with self.attackers(["controller_commands"], 0, "127.0.0.1"):
            while not {"moves", "press"} <= set(self.witness.counts - before) and time.monotonic() < end_s:
                time.sleep(0.1)
        words = self.witness.counts - before
        self.operator.until(self.stands, "standstill", stop=True)
        self._end_session()
        return words

    @contextlib.contextmanager
    def attackers(self, attacks: Sequence[str], pairing_port: int, address: str) -> Any:
        """A process that attacks until its input ends."""
        command = [sys.executable, str(HERE / "red_team.py"), address, *attacks,
                   "--status-port", str(self.stack.status_port), "--command-port", str(self.stack.command_port),
                   # A key may begin with a hyphen, as an option does.
                   "--pairing-port", str(pairing_port), "--robot-key=" + self.keys.own_keys().public.decode("ascii"),
                   "--keys", str(self.folder / "known.json"), "--recording", str(self.folder / "recording")]
        process = subprocess.Popen(command, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            yield process
        finally:
            process.kill()
            process.wait()

    def _end_session(self) -> None:
        self.operator.end_session()
        self.operator.look(0.1)
