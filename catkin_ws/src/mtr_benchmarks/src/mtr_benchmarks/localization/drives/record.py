"""Records one drive around the Car on the simulator's core: drive.bag, truth.csv and meta.json.

Usage: python -m mtr_benchmarks.localization.drives.record --scene lot --car hatchback --lidar-height 0.3 --out DIR
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import math
import pathlib
import sys
from dataclasses import asdict, fields
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import LIMITS
from mtr_core.schedule import CAR_LOCATOR, CLOCK_STEP, LIDAR, SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_msgs.msg import MappingOrder
from mtr_simulation.noise import stream
from mtr_simulation.sim import TICK_S, Sim
from mtr_simulation.site.car_shape import size_at

from .legs import CarryLeg, Leg, LegFollower, LiftLeg, WanderLeg, leg_name
from .options import RANDOM, DriveOptions
from .pattern import LOOP, START, DrivePiece, DrivePlan, pieces
from .recording import Recording, pose_values
from .site_bodies import random_jump, site_bodies
from .wandering import Wanderer

# Options of the command line are the fields of DriveOptions; some omit their unit.
ALIASES = {"lidar_height_m": "lidar-height", "range_bias_m": "range-bias", "opposed_bias_m": "opposed-bias",
           "range_noise_m": "range-noise", "duration_s": "duration"}
MAP_CAR_ID = 1
# Mapping phase by kind of leg. The map is frozen when the loop is complete.
PHASES = {START: MappingOrder.IDLE, LOOP: MappingOrder.COLLECT}
LEG_LIMIT_S = 120.0
EIGHTH_RAD = math.pi / 4.0
# Distance from the Car that leaves room before the obstacles of the lot.
REACH_M = {"lot": 3.5}
FULL_REACH_M = 10.0
# Limits of the time for which a robot wanders before its abduction.
MIN_WANDER_S, MAX_WANDER_S = 3.0, 8.0


class DriveError(Exception):
    """The robot did not reach the end of the drive."""


def plan(options: DriveOptions) -> DrivePlan:
    """Return axes and radials of a drive; the seeds together cover all directions."""
    if options.car == RANDOM:
        return DrivePlan((), (), 0.0, closed=options.neighbour)
    first = options.seed % 8
    axes = tuple(EIGHTH_RAD * ((first + 3 * step) % 8) for step in range(4))
    # No radial leads to the right, where a person may walk.
    radials = tuple(EIGHTH_RAD * ((options.seed + step) % 5) for step in (0, 2))
    wander_s = float(chance(options, "abduction").uniform(MIN_WANDER_S, MAX_WANDER_S))
    return DrivePlan(axes, radials, REACH_M.get(options.scene, FULL_REACH_M), options.duration_s > 0.0, options.kidnap,
                     wander_s if options.abduct else None)


def chance(options: DriveOptions, name: str) -> np.random.Generator:
    """Return a random generator of a drive that also depends on the scene, so that equal seeds give different cases."""
    return stream(options.seed, f"{name} in {options.scene}")


def record(options: DriveOptions, folder: pathlib.Path) -> Dict[str, Any]:
    """Record the drive; return the content of meta.json."""
    sim = options.sim()
    start = sim.truth()
    segments: List[Dict[str, Any]] = []
    with Recording(folder, options.lidar_height_m) as files:
        files.mounts(SIMULATION_START_NS)
        driving = _Driving(sim, files, options)
        for index, piece in enumerate(pieces(options.shape, start.car_from_base, plan(options))):
            segments.append(driving.follow(index, piece))
            if options.duration_s and sim.time_ns * 1e-9 > options.duration_s:
                break
        meta = _meta(options, start.world_from_base, segments)
        files.meta(meta)
    return meta


def _meta(options: DriveOptions, world_from_start: Pose2, segments: List[Dict[str, Any]]) -> Dict[str, Any]:
    site, shape = options.scenario(), options.shape
    end_s = segments[-1]["end_s"]
    return {"options": asdict(options), "map_from_car": pose_values(world_from_start.inverse() @ site.world_from_car),
            "prior_car_from_start": pose_values(site.start_in_car), "world_from_car": pose_values(site.world_from_car),
            "length_m": shape.length_m, "width_m": shape.width_m,
            "wheelbase_m": shape.wheelbase_m, "front_overhang_m": 0.5 * (shape.length_m - shape.wheelbase_m),
            "at_lidar": size_at(shape, options.lidar_height_m)._asdict(),
            "loop_end_s": max((each["end_s"] for each in segments if each["kind"] == LOOP), default=end_s),
            "end_s": end_s, "segments": segments}


class _Driving:
    """Follows legs and records the sensors."""

    def __init__(self, sim: Sim, files: Recording, options: DriveOptions):
        self._sim, self._files, self._options = sim, files, options
        self._bodies, self._chance = site_bodies(sim.scenario), chance(options, "wandering")

    def follow(self, index: int, piece: DrivePiece) -> Dict[str, Any]:
        """Follow one leg to its end; return its entry in meta.json."""
        sim, begin_ns = self._sim, self._sim.time_ns
        follower, carried = self._begin(piece.leg)
        done = False
        while not done:
            velocity, done = follower.update(sim.truth().car_from_base)
            sim.command(*velocity)
            self._tick(index, PHASES.get(piece.kind, MappingOrder.FREEZE))
            if (sim.time_ns - begin_ns) * 1e-9 > LEG_LIMIT_S:
                raise DriveError(f"Leg {index}, {piece.leg}, is not finished after {LEG_LIMIT_S:.0f} s at "
                                 f"{sim.truth().car_from_base}.")
            if sim.contacts():
                raise DriveError(f"The robot touches {', '.join(sorted(sim.contacts()))} on leg {index}, {piece.leg}.")
        return {"index": index, "kind": piece.kind, "leg": leg_name(piece.leg), "line_rad": piece.line_rad,
                "begin_s": begin_ns * 1e-9, "end_s": sim.time_ns * 1e-9, **carried}

    def _begin(self, leg: Leg) -> Tuple[Union[LegFollower, Wanderer], Dict[str, float]]:
        """Return the controller of the leg, and for meta.json how the robot was carried at its beginning."""
        sim = self._sim
        carried: Dict[str, float] = {}
        if isinstance(leg, WanderLeg):
            return Wanderer(self._bodies, self._chance, leg.duration_s, TICK_S), carried
        if isinstance(leg, LiftLeg):
            sim.kidnap(sim.truth().world_from_base @ Pose2(0.0, leg.aside_m, leg.turn_rad))
        if isinstance(leg, CarryLeg):
            carried = self._carry()
        return LegFollower(leg, sim.truth().car_from_base, TICK_S), carried

    def _carry(self) -> Dict[str, float]:
        here = self._sim.truth().car_from_base
        try:
            jump = random_jump(self._bodies, here, self._chance)
        except ValueError as error:
            raise DriveError(str(error)) from None
        self._sim.kidnap(self._sim.scenario.world_from_car @ jump.applied(here))
        return jump._asdict()

    def _tick(self, index: int, phase: int) -> None:
        sim, files = self._sim, self._files
        sweep = (sim.time_ns - SIMULATION_START_NS) // LIDAR.period_ns
        sim.scans_wanted = sweep % self._options.sweeps_apart == 0
        sensors = sim.step()
        if CAR_LOCATOR.last_at(sim.time_ns) == sim.time_ns:
            files.mapping(sim.time_ns, MAP_CAR_ID if phase else 0, phase)
        files.sensors(sensors)
        # The truth of a long drive is recorded as rarely as its sweeps.
        if sim.time_ns // CLOCK_STEP.period_ns % self._options.sweeps_apart == 0:
            files.truth(sim.truth(), index)


def main(arguments: Optional[List[str]] = None) -> int:
    """Record the drive that the command line describes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for item in fields(DriveOptions):
        name = "--" + ALIASES.get(item.name, item.name.replace("_", "-"))
        if isinstance(item.default, bool):
            parser.add_argument(name, dest=item.name, action="store_true")
        else:
            parser.add_argument(name, dest=item.name, type=type(item.default), default=item.default,
                                metavar=item.metadata[LIMITS].unit.strip("()") or None if item.metadata else None,
                                help=f"default {item.default}")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder of the files")
    values = vars(parser.parse_args(arguments))
    folder = values.pop("out")
    try:
        meta = record(DriveOptions(**values), folder)
    except (ConfigurationError, DriveError) as error:
        print(error, file=sys.stderr)
        return 1
    print(f"{folder}: {meta['end_s'] - SIMULATION_START_NS * 1e-9:.0f} s, loop ends at {meta['loop_end_s']:.2f} s.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
