"""Selection of the drives of the benchmark."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import List, NamedTuple

from .options import RANDOM, DriveOptions
from .random_car import random_car

SCENES = ("lot", "far", "cones", "open")
CARS = ("hatchback", "sedan", "van")
PLAIN, RANGE_BIAS, OPPOSED, TILT, PITCHED, KIDNAP, CAMPAIGN, ABDUCT, ANY_CAR = (
    "plain", "range_bias", "opposed_bias", "tilt", "pitched", "kidnap", "campaign", "abduct", "any_car")
SEEDS, VARIANT_SEEDS, OPPOSED_SEEDS, KIDNAP_SEEDS, QUICK_SEEDS = 10, 5, 3, 3, 2
# Number of robots per scene that are carried away while they drive.
ABDUCTIONS, QUICK_ABDUCTIONS = 50, 2
# Number of random Cars; each is mapped once.
ANY_CARS, QUICK_ANY_CARS = 200, 8
# A drive that proves nothing is repeated with its seed plus a multiple of this number, which no other drive uses.
NEXT_SEED = 100_000
RANGE_BIAS_M, OPPOSED_BIAS_M, TILT_DEG, PITCH_DEG = 0.02, 0.01, 1.0, 0.7
KIDNAP_SCENES, PITCHED_SCENES, LIDAR_SCENES = ("lot", "open"), ("open", "cones"), ("lot", "open")
# Duration of a working day. Only one in four sweeps is recorded, so that the recording has 2 GB instead of 8 GB.
CAMPAIGN_S, QUICK_CAMPAIGN_S, CAMPAIGN_SWEEPS_APART = 8.0 * 3600.0, 900.0, 4


class LidarKind(NamedTuple):
    """Non-standard LiDARs; all other drives have two with 720 beams over 270 deg at 25 Hz."""

    name: str
    beams: int
    field_deg: float
    sweeps_apart: int
    rear: bool


# Kinds by name of the variant: few to many beams, narrow to full circle, 25 to 5 Hz.
LIDAR_KINDS = {f"lidar-{kind.name}": kind for kind in (
    LidarKind("few-beams", 180, 180.0, 2, True), LidarKind("one", 720, 270.0, 1, False),
    LidarKind("narrow", 360, 90.0, 1, True), LidarKind("slow", 360, 360.0, 5, False),
    LidarKind("many-beams", 4000, 360.0, 5, False))}


class BenchmarkDrive(NamedTuple):
    """One drive and its variant; plain drives are also evaluated with the other methods."""

    options: DriveOptions
    variant: str

    @property
    def name(self) -> str:
        """Name of the drive's folder."""
        return f"{self.options.scene}_{self.variant}_{self.options.seed}"


def all_drives(quick: bool = False) -> List[BenchmarkDrive]:
    """Return all drives; those with additional errors reuse seeds of the plain drives, so that nothing else differs."""
    seeds, variant_seeds, opposed_seeds, kidnap_seeds = (
        (QUICK_SEEDS,) * 4 if quick else (SEEDS, VARIANT_SEEDS, OPPOSED_SEEDS, KIDNAP_SEEDS))
    # The longest drive is first, so that it does not run alone at the end.
    campaign = replace(options("lot", 1), duration_s=QUICK_CAMPAIGN_S if quick else CAMPAIGN_S,
                       sweeps_apart=CAMPAIGN_SWEEPS_APART)
    drives = [BenchmarkDrive(campaign, CAMPAIGN)]
    drives += [BenchmarkDrive(options(scene, seed), PLAIN) for scene in SCENES for seed in range(1, seeds + 1)]
    for scene in SCENES:
        for seed in range(1, variant_seeds + 1):
            plain = options(scene, seed)
            drives.append(BenchmarkDrive(replace(plain, range_bias_m=RANGE_BIAS_M), RANGE_BIAS))
            drives.append(BenchmarkDrive(replace(plain, tilt_deg=TILT_DEG), TILT))
    drives += [BenchmarkDrive(replace(options(scene, seed), opposed_bias_m=OPPOSED_BIAS_M), OPPOSED) for scene in SCENES
               for seed in range(1, opposed_seeds + 1)]
    drives += [BenchmarkDrive(replace(options(scene, seed), mount_tilt_deg=PITCH_DEG), PITCHED)
               for scene in PITCHED_SCENES for seed in range(1, opposed_seeds + 1)]
    drives += [BenchmarkDrive(with_lidars(options(scene, 1), kind), variant) for variant, kind in LIDAR_KINDS.items()
               for scene in LIDAR_SCENES]
    drives += [BenchmarkDrive(replace(options(scene, seed), kidnap=True), KIDNAP) for scene in KIDNAP_SCENES
               for seed in range(1, kidnap_seeds + 1)]
    return drives


def abductions(robots: int, first_seed: int = 1) -> List[BenchmarkDrive]:
    """Return the drives in which robots are carried away, `robots` per scene; the scenes alternate."""
    return [BenchmarkDrive(replace(options(scene, seed), abduct=True), ABDUCT)
            for seed in range(first_seed, first_seed + robots) for scene in SCENES]


def any_cars(cars: int, first_seed: int = 1) -> List[BenchmarkDrive]:
    """Return the drives around random Cars; the scenes alternate."""
    return [BenchmarkDrive(any_car(SCENES[seed % len(SCENES)], seed), ANY_CAR)
            for seed in range(first_seed, first_seed + cars)]


def any_car(scene: str, seed: int) -> DriveOptions:
    """Return the drive around the seed's random Car, with the seed's random robot."""
    drawn = random_car(seed)
    return DriveOptions(scene=scene, seed=seed, car=RANDOM, lidar_height_m=drawn.lidar_height_m, rear=drawn.rear_lidar)


def with_lidars(plain: DriveOptions, kind: LidarKind) -> DriveOptions:
    """Return the same drive with LiDARs of another kind."""
    return replace(plain, beams=kind.beams, field_deg=kind.field_deg, sweeps_apart=kind.sweeps_apart, rear=kind.rear)


def repeated(drive: BenchmarkDrive) -> BenchmarkDrive:
    """Return the same drive with the next seed. Car and LiDAR height stay the same, unless they are random."""
    seed = drive.options.seed + NEXT_SEED
    return drive._replace(options=any_car(drive.options.scene, seed) if drive.variant == ANY_CAR
                          else replace(drive.options, seed=seed))


def options(scene: str, seed: int) -> DriveOptions:
    """Return the options of a seed: six consecutive seeds cover all shapes and heights; every third has a person."""
    return DriveOptions(scene=scene, seed=seed, car=CARS[seed % 3], lidar_height_m=0.3 if seed % 2 else 0.2,
                        rear=True, person=seed % 3 == 2)
