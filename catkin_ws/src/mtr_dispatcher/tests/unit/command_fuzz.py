"""Feeds mutated Commands to the dispatcher's core: each must be refused or result in a valid desired state.

Usage: command_fuzz.py [--cases N] [--seed N] [--out FOLDER]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import json
import math
import pathlib
import random
import resource
import sys
import time

from mtr_dispatcher.command import MAX_BUTTON, MAX_BUTTONS, MAX_COORDINATE_M, MAX_KEY_HEIGHT_M, MAX_PRESS_DURATION_S
from mtr_dispatcher.conversions import desired_message, lock_message
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.session import CommandResult
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link

MEMORY_BYTES = 6 * 1000 ** 3
LIMIT_S = 1.0
MAX_STATUS_BYTES = 64 * 1024
NUMBERS = (0.0, -0.0, 1.0, -1.0, 0.5, 99.9, 100.1, 1e9, -1e30, 1e308, math.inf, -math.inf, math.nan)
IDS = (0, 1, 2, 3, 1000, 1002, 2 ** 31, 2 ** 63 - 1, 2 ** 63, 2 ** 64 - 1)
MUST = ("uncaught exceptions", "hangs of more than 1 s", "accepted nonsense")


def command(chance: random.Random, newest: Dispatcher, now_s: float) -> bytes:
    """Return the bytes of a Command with invalid values in some fields, in some cases corrupted."""
    status_id, newest_id, session_id = newest.status_id, newest.session._newest_id, newest.session.session_id or 1
    answered = chance.choice([status_id, status_id, status_id, chance.choice(IDS)])
    seen_s = chance.choice([now_s, now_s, now_s - 0.9, now_s - 3.0, chance.choice(NUMBERS)])
    message = link.Command(session_id=chance.choice([session_id] * 4 + [2, chance.choice(IDS)]),
                           id=chance.choice([newest_id, newest_id + 1, newest_id + 2, chance.choice(IDS)]) % 2 ** 64,
                           seen_status_id=answered, seen_robot_time_s=seen_s, stop=chance.random() < 0.2,
                           map_car_id=chance.choice(IDS), check_car_id=chance.choice(IDS),
                           resume_hold_id=chance.choice(IDS), end_session=chance.random() < 0.02)
    if chance.random() < 0.7:
        numbers = [chance.choice((1.0, 2.0, chance.choice(NUMBERS))) for _ in range(3)]
        message.waypoint.CopyFrom(link.Waypoint(id=chance.choice([1, 2, 3, *IDS]), x=numbers[0], y=numbers[1],
                                                heading=numbers[2], direction=chance.choice([0, 1, 2])))
    if chance.random() < 0.5:
        count = chance.choice([1, 1, 2, 3, 8, 9, 5000])
        message.press.CopyFrom(link.ButtonPress(
            id=chance.choice(IDS), buttons=[chance.choice([1, 2, chance.randrange(2 ** 32)]) for _ in range(count)],
            strength=chance.choice([0.5, 1.0, 0.7, chance.choice(NUMBERS)]),
            duration_s=chance.choice([0.1, 0.5, 1.5, chance.choice(NUMBERS)])))
    if chance.random() < 0.5:
        message.max_speed_mps = chance.choice([0.5, 1.0, chance.choice(NUMBERS[:9])])
        message.device_height_m = chance.choice([0.5, 1.0, chance.choice(NUMBERS[:9])])
    return mutated(chance, message.SerializeToString())


def mutated(chance: random.Random, data: bytes) -> bytes:
    """Return the bytes, in one of four cases truncated, changed or repeated."""
    kind, place = chance.randrange(12), chance.randrange(len(data))
    if kind == 0:
        return data[:place]
    if kind == 1:
        return data[:place] + bytes([chance.randrange(256)]) + data[place + 1:]
    return data + data[place:] * chance.randrange(200) if kind == 2 else data


def nonsense_of(core: Dispatcher, now_s: float) -> str:
    """Return the first invalid part of the desired state, or an empty text."""
    state = core.desired(now_s)
    desired = desired_message(state, None, 0.5)
    lock = lock_message(state, None)
    if len(lock.reason) > 1000:
        return f"a reason of {len(lock.reason)} characters"
    waypoint, press = desired.waypoint, desired.press
    checks = {
        "coordinate": abs(waypoint.x) <= MAX_COORDINATE_M and abs(waypoint.y) <= MAX_COORDINATE_M,
        "heading": abs(waypoint.heading) <= 4.0 * math.pi + 1e-9,
        "speed": 0.01 <= desired.max_speed_mps <= 2.0,
        "height": math.isnan(desired.key_height_m) or 0.0 <= desired.key_height_m <= MAX_KEY_HEIGHT_M,
        "buttons": (len(press.buttons) <= MAX_BUTTONS and len(set(press.buttons)) == len(press.buttons)
                    and all(1 <= button <= MAX_BUTTON for button in press.buttons)),
        "press": 0.0 <= press.strength <= 1.0 and 0.0 <= press.duration_s <= MAX_PRESS_DURATION_S,
        "stop": desired.stop or desired.link_alive}
    return next((name for name, right in checks.items() if not right), "")


class Fuzz:
    """Runs cases and counts their results."""

    def __init__(self, seed: int):
        self.counts: collections.Counter[str] = collections.Counter()
        self.worst_s = 0.0
        self._chance = random.Random(seed)
        self._core, self._now_s = Dispatcher(Parameters(), Identity(7, "fuzz", 0.25, 0.0)), 1000.0

    def run(self, cases: int) -> None:
        """Run further cases."""
        for _ in range(cases):
            began_s = time.process_time()
            try:
                self._case()
            except Exception as error:
                self.counts[MUST[0]] += 1
                print(f"{type(error).__name__}: {error}")
            used_s = time.process_time() - began_s
            self.worst_s = max(self.worst_s, used_s)
            self.counts[MUST[1]] += used_s > LIMIT_S
            self.counts["cases"] += 1

    def _case(self) -> None:
        core, chance = self._core, self._chance
        self._now_s += chance.choice([0.0, 0.02, 0.1, 0.1, 4.0 if chance.random() < 0.05 else 0.1])
        result, _ = core.receive(command(chance, core, self._now_s), self._now_s)
        self.counts[result.value if isinstance(result, CommandResult) else "undecodable"] += 1
        status = core.status(Inputs(self._now_s, steady_s=self._now_s))
        problem = nonsense_of(core, self._now_s) or ("size" if len(status) > MAX_STATUS_BYTES else "")
        if problem:
            self.counts[MUST[2]] += 1
            print(f"accepted: {problem}")


def main() -> int:
    """Run the command line; return 1 if a problem was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--cases", type=int, default=100_000, help="default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    fuzz = Fuzz(options.seed)
    fuzz.run(options.cases)
    found = sum(fuzz.counts[name] for name in MUST)
    figures = {**fuzz.counts, "slowest, ms": round(1000.0 * fuzz.worst_s)}
    rows = [{"name": f"Commands: {name}", "unit": "(count)", "value": fuzz.counts[name], "must": 0,
             "is_met": not fuzz.counts[name]} for name in MUST]
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "fuzz_commands.json").write_text(json.dumps({"table": rows, "figures": figures}, indent=1) + "\n",
                                                    encoding="utf-8")
    print(json.dumps(figures, indent=1))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
