"""Disturbances of a line: each changes the world at a random time by a random amount, independently of the judge."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
from typing import Callable, Dict, NamedTuple, Optional

from .car import SOURCE_BUTTON, SOURCE_NONE, Frame, Order, lock_data
from .robot import Push
from .world import World

# Values of LastCommandSource that the profile does not list.
UNLISTED_SOURCES = (SOURCE_NONE, 3, 5, 7)


class Disturbance(NamedTuple):
    """True times of the beginning and end of a disturbance."""

    begin_s: float
    end_s: float


Make = Callable[[World, random.Random, float], Disturbance]


def nothing(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Do not disturb the line."""
    return Disturbance(math.inf, math.inf)


def frame_glitch(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Corrupt, repeat or lose one or several frames."""
    kind = chance.choice(("state", "state", "flag", "repeat", "lose", "counter"))
    end_s = at_s + 0.02 * chance.choice((1, 1, 1, 2, 3, 5))
    state, frames = chance.randrange(4), chance.randrange(2, 15)

    def spoil(frame: Frame) -> Optional[Frame]:
        if not at_s <= frame.time_s < end_s:
            return frame
        data = bytearray(frame.data)
        if kind == "lose":
            return None
        if kind == "repeat":
            data[2] = (data[2] - frames) % 16
        elif kind == "counter":
            data[1] = (data[1] + frames) % 256
        else:
            data[0] = data[0] & ~3 | state | (4 if kind == "flag" else 0)
        return Frame(frame.time_s, bytes(data))

    world.car.spoil = spoil
    return Disturbance(at_s, end_s)


def cause(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Unlock or lock the Car by another cause: another key, a handle, a switch."""
    source = chance.choice((SOURCE_BUTTON, *UNLISTED_SOURCES))
    world.car.foreign.append(Order(at_s, chance.random() < 0.5, source))
    return Disturbance(at_s, at_s)


def relock(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Let the Car lock by itself."""
    world.car.foreign.append(Order(at_s, True, chance.choice((SOURCE_NONE, 3))))
    return Disturbance(at_s, at_s)


def clock_step(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Set the clock of the robot or of the CAN adapter."""
    clock = world.robot_clock if not world.is_stamped or chance.random() < 0.7 else world.adapter_clock
    clock.steps.append((at_s, chance.choice((-1.0, 1.0)) * 10.0 ** chance.uniform(math.log10(0.02), 1.0)))
    return Disturbance(at_s, at_s)


def lateral_offset(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Let the robot drive off its line without a reason that it reports."""
    world.robot.beside = (at_s, chance.choice((-1.0, 1.0)) * chance.uniform(0.02, 2.0))
    return Disturbance(at_s, math.inf)


def height(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Move the key away from its height, manually or by itself."""
    world.robot.heights = (at_s, chance.choice((-1.0, 1.0)) * chance.uniform(0.02, 0.6))
    world.robot.lifted_by_hand = chance.random() < 0.3
    return Disturbance(at_s, math.inf)


def hand(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Drive the robot manually for a while."""
    end_s, angle, speed = at_s + chance.uniform(0.1, 4.0), chance.uniform(-math.pi, math.pi), chance.uniform(0.1, 0.8)
    world.robot.pushes.append(Push(at_s, end_s, speed * math.cos(angle), speed * math.sin(angle)))
    return Disturbance(at_s, end_s)


def blocked(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Stop the robot by an obstacle for a while."""
    world.robot.blocks.append((at_s, at_s + chance.uniform(0.1, 5.0)))
    return Disturbance(*world.robot.blocks[-1])


def frozen_frame(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Let a gateway repeat the same frame."""
    end_s = at_s + chance.choice((0.1, 0.3, 1.0, 3.0, 10.0, math.inf))
    last = Frame(at_s, lock_data(int(not world.car.locked), False, SOURCE_NONE, 0, 0))

    def spoil(frame: Frame) -> Frame:
        nonlocal last
        if at_s <= frame.time_s < end_s:
            return Frame(frame.time_s, last.data)
        last = frame
        return frame

    world.car.spoil = spoil
    return Disturbance(at_s, end_s)


def lost_status(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Interrupt the Wi-Fi, or lose every third message, for a while."""
    end_s, share = at_s + chance.uniform(0.1, 4.0), chance.choice((0.3, 1.0))
    world.loses = lambda time_s: at_s <= time_s < end_s and chance.random() < share
    return Disturbance(at_s, end_s)


def stall(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Delay the reading of frames and Statuses by a busy laptop."""
    stall_s = (at_s, at_s + chance.uniform(0.05, 1.0))
    world.frame_way.stalls.append(stall_s)
    world.status_way.stalls.append(stall_s)
    return Disturbance(*stall_s)


def late_press(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Delay presses after their order, or execute a press of an abandoned order."""
    if chance.random() < 0.5:
        world.robot.press_delay_s = chance.uniform(0.1, 12.0)
        return Disturbance(-math.inf, math.inf)
    world.robot.waiting.append((at_s, 1_000_000, chance.random() < 0.5, 0.3))
    return Disturbance(at_s, at_s)


def late_reaction(world: World, chance: random.Random, at_s: float) -> Disturbance:
    """Delay the Car's reaction to each press, or to the first ones, so that it reacts during the next press."""
    world.late_reaction_s = chance.uniform(0.6, 4.0)
    world.late_presses = chance.choice((1, 2, 5, 1000))
    return Disturbance(-math.inf, math.inf)


BOTH: Dict[str, Make] = {"none": nothing, "frame glitch": frame_glitch, "cause": cause, "relock": relock,
                         "clock step": clock_step, "lateral offset": lateral_offset, "height": height, "hand": hand,
                         "blocked": blocked, "frozen frame": frozen_frame, "lost Status": lost_status,
                         "stall": stall}
OF_PRESSES: Dict[str, Make] = {**BOTH, "late press": late_press, "late reaction": late_reaction}
