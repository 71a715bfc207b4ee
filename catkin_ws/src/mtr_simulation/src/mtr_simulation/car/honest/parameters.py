"""Parameters of the honest Car: radio, key, passive entry, locks and bus, one class for each section of its file.

Ranges and defaults are of real cars and keys according to public sources; the module of each radio effect states its
source.
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
from dataclasses import dataclass
from typing import Any, ClassVar, Dict, Mapping, Tuple

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.parameters import Limits, ParameterSet, number

from ..parameters import DEFAULT_ANTENNAS, LfAntenna

UNLOCK_ON = ("approach", "handle")
WALK_AWAY = ("distance", "delay", "off")
UNLOCK_DOORS = ("all", "driver")
CAUSE_IN = ("same", "other", "none")
# Antenna values that a file may change; places are on a car, strengths are limited by LfAntenna.
ANTENNA_LIMITS = {"x_m": Limits(-5.0, 5.0, "m"), "y_m": Limits(-2.0, 2.0, "m"), "z_m": Limits(0.0, 3.0, "m"),
                  "axis_rad": Limits(-math.pi, math.pi, "rad"), "strength_db": Limits(-40.0, 40.0, "dB"),
                  "lobe_db": Limits(0.0, 10.0, "dB"), "lobe_rad": Limits(-math.pi, math.pi, "rad")}


def check_word(name: str, word: str, allowed: Tuple[str, ...]) -> None:
    """Raise ConfigurationError unless the word is allowed."""
    if word not in allowed:
        raise ConfigurationError(f"Parameter {name} is '{word}'; allowed is {', '.join(allowed)}.")


@dataclass(frozen=True)
class UhfParameters(ParameterSet):
    """Link from the key to the Receiver."""

    PREFIX: ClassVar[str] = "uhf."

    frequency_mhz: float = number(434.0, 300.0, 1000.0, "MHz")
    margin_at_1m_db: float = number(44.0, 0.0, 120.0, "dB")  # above the decoding threshold, in free space
    ground_permittivity: float = number(5.0, 1.5, 80.0, "(relative)")  # dry asphalt 4 to 7, wet to 30 (ITU-R P.527)
    fading_sigma_db: float = number(6.0, 0.0, 12.0, "dB")


@dataclass(frozen=True)
class NoiseParameters(ParameterSet):
    """Variations between attempts at the same place."""

    PREFIX: ClassVar[str] = "noise."

    sigma_db: float = number(2.0, 0.1, 6.0, "dB")
    correlation_s: float = number(0.3, 0.02, 2.0, "s")
    lapse: float = number(0.02, 0.0, 0.5, "(probability)")  # random miss at any strength: collisions, a busy receiver


@dataclass(frozen=True)
class KeyParameters(ParameterSet):
    """The Remote key."""

    PREFIX: ClassVar[str] = "key."

    battery_v: float = number(3.0, 1.5, 3.4, "V")
    silent_below_v: float = number(2.1, 1.5, 3.0, "V")
    axis_azimuth_deg: float = number(65.0, -180.0, 180.0, "degrees")  # axis of the loop antenna in the key's frame
    axis_elevation_deg: float = number(20.0, -90.0, 90.0, "degrees")
    pattern_floor_db: float = number(-12.0, -40.0, 0.0, "dB")  # 0: no pattern
    sleep_after_s: float = number(180.0, 0.0, 3600.0, "s")  # at rest; 0: never. Thatcham requires 1 to 30 minutes
    wake_move_m: float = number(0.01, 0.001, 1.0, "m")
    buttons_wake: bool = True  # else the buttons of a sleeping key have no effect
    contact_travel: float = number(0.6, 0.0, 1.0, "of the servo's full travel")
    contact_ms: int = number(80, 0, 2000, "ms")  # a shorter contact counts as bouncing
    # Additional strength that a button needs above the decoding threshold: makers limit it to the sight of the Car.
    button_needs_db: float = number(32.0, 0.0, 80.0, "dB")


@dataclass(frozen=True)
class PassiveParameters(ParameterSet):
    """Passive entry: the Car polls the key by its low-frequency field, the key answers by UHF."""

    PREFIX: ClassVar[str] = "passive_entry."

    enabled: bool = True
    unlock_on: str = "approach"  # or handle: only on a handle request
    unlock_threshold_db: float = number(0.0, -60.0, 40.0, "dB")
    lock_threshold_db: float = number(-12.0, -60.0, 40.0, "dB")
    poll_period_ms: int = number(300, 20, 1000, "ms")
    debounce_polls: int = number(2, 1, 10, "polls")
    walk_away: str = "distance"  # or delay: this time after the key has left the unlock zone; or off
    walk_away_delay_s: float = number(5.0, 0.0, 60.0, "s")
    handle_period_s: float = number(0.0, 0.0, 60.0, "s")  # period of simulated hands at the handle; 0: only on request
    extender_db: float = number(0.0, 0.0, 120.0, "dB")  # gain of an extender on the field while it is on
    shadow_sigma_db: float = number(1.0, 0.0, 10.0, "dB")
    shadow_correlation_m: float = number(0.5, 0.05, 10.0, "m")
    # Response time of the truth: time at a place after which a missing reaction counts as none.
    response_s: float = number(3.0, 0.1, 30.0, "s")

    def __post_init__(self) -> None:
        super().__post_init__()
        check_word(f"{self.PREFIX}unlock_on", self.unlock_on, UNLOCK_ON)
        check_word(f"{self.PREFIX}walk_away", self.walk_away, WALK_AWAY)
        if self.lock_threshold_db > self.unlock_threshold_db:
            raise ConfigurationError(f"Parameter {self.PREFIX}lock_threshold_db is {self.lock_threshold_db:g} dB; "
                                     f"allowed is up to unlock_threshold_db, {self.unlock_threshold_db:g} dB.")
        if self.response_s * 1000.0 < self.poll_period_ms * self.debounce_polls:
            raise ConfigurationError(f"Parameter {self.PREFIX}response_s is {self.response_s:g} s; that is less than "
                                     f"{self.debounce_polls} polls of {self.poll_period_ms} ms take.")


@dataclass(frozen=True)
class LockParameters(ParameterSet):
    """Central locking."""

    PREFIX: ClassVar[str] = "locks."

    boot_ms: int = number(200, 0, 10_000, "ms")  # the state is unknown until then
    actuator_ms: int = number(100, 0, 1000, "ms")  # from the decision to the moved lock
    relock_s: float = number(30.0, 0.0, 600.0, "s")  # after an unlock without an opened door; 0: never
    unlock_doors: str = "all"  # or driver: only the driver's door at the first unlock
    second_key_inside: bool = False  # the Car then does not lock by passive entry or its timer

    def __post_init__(self) -> None:
        super().__post_init__()
        check_word(f"{self.PREFIX}unlock_doors", self.unlock_doors, UNLOCK_DOORS)


@dataclass(frozen=True)
class BusParameters(ParameterSet):
    """Messages of the Car on its bus."""

    PREFIX: ClassVar[str] = "bus."

    lock_cycle_ms: int = number(200, 20, 800, "ms")
    sent_on_change: bool = False  # the lock message is also sent immediately when the state changes
    cause_in: str = "same"  # the lock message contains the cause; or other: a separate message; or none
    cause_cycle_ms: int = number(500, 20, 800, "ms")
    event_counter: bool = True  # else it stays 0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_word(f"{self.PREFIX}cause_in", self.cause_in, CAUSE_IN)


@dataclass(frozen=True)
class HonestParameters(ParameterSet):
    """All parameters of the Car. place_seed determines effects fixed in space; the simulation's seed all other
    randomness.

    antennas: antennas of the passive entry; default: the gentle Car's antennas.
    """

    PREFIX: ClassVar[str] = ""

    place_seed: int = number(1, 0, 2**31 - 1)
    uhf: UhfParameters = UhfParameters()
    noise: NoiseParameters = NoiseParameters()
    key: KeyParameters = KeyParameters()
    passive_entry: PassiveParameters = PassiveParameters()
    locks: LockParameters = LockParameters()
    bus: BusParameters = BusParameters()
    antennas: Tuple[LfAntenna, ...] = DEFAULT_ANTENNAS

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.antennas:
            raise ConfigurationError("Parameter antennas is empty; allowed is one or more.")


def changed_antennas(changes: Mapping[str, Any]) -> Tuple[LfAntenna, ...]:
    """Return the default antennas with changed values, by name.

    Raises:
        ConfigurationError: a name or value is invalid.
    """
    known = {antenna.name: antenna for antenna in DEFAULT_ANTENNAS}
    for name, values in changes.items():
        if name not in known:
            raise ConfigurationError(f"Antenna {name} is unknown; allowed are {', '.join(known)}.")
        if not isinstance(values, dict):
            raise ConfigurationError(f"Antenna {name} is {values!r}; allowed is a table of names and values.")
        known[name] = _changed(known[name], values)
    return tuple(known.values())


def _changed(antenna: LfAntenna, values: Mapping[str, Any]) -> LfAntenna:
    for name, value in values.items():
        if name not in ANTENNA_LIMITS:
            raise ConfigurationError(f"Parameter {name} of antenna {antenna.name} is unknown; allowed are "
                                     f"{', '.join(ANTENNA_LIMITS)}.")
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise ConfigurationError(f"Parameter {name} of antenna {antenna.name} is {value!r}; allowed is a number.")
        limits = ANTENNA_LIMITS[name]
        check_range(f"antennas.{antenna.name}.{name}", float(value), limits.low, limits.high, limits.unit)
    changes: Dict[str, Any] = {name: float(value) for name, value in values.items()}
    return dataclasses.replace(antenna, **changes)
