"""Requirements on the base's controller and its topics; plain values in, findings out."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, Iterator, List, Optional, Sequence

from mtr_core import names
from mtr_motion_check.finding import Finding, bad, good

from ..preflight.base import switch_problems, value_of
from ..preflight.expected import Setup
from ..preflight.records import RobotRecord
from ..preflight.topics import topic_findings

LIMITS, LISTENS, FRAMES = "contract.limits", "contract.listens", "contract.frames"
# Topics of the base itself; LiDARs, firmware and joystick are separate.
TOPICS = (names.WHEEL_COMMAND, names.WHEEL_ODOMETRY, names.IMU_DATA, names.BATTERY)
NEEDED = {"cmd_vel_timeout": "s", "linear/x/max_velocity": "m/s", "linear/x/max_acceleration": "m/s2",
          "angular/z/max_velocity": "rad/s", "angular/z/max_acceleration": "rad/s2"}


def limit_findings(where: str, base: Optional[Dict[str, Any]]) -> List[Finding]:
    """Check that each limit exists as a number; drive control checks its value at the start, against the mast."""
    if base is None:
        return [bad(LIMITS, where, "There are no parameters of the base's controller; load them there, see "
                    "docs/other-bases.md, or start with base_guard:=true.")]
    problems = [*switch_problems(where, base), *_missing(where, base)]
    return problems or [good(LIMITS, where, "Time-out, speeds and accelerations are there.")]


def _missing(where: str, base: Dict[str, Any]) -> Iterator[Finding]:
    for name, unit in NEEDED.items():
        value = value_of(base, name)
        if not isinstance(value, (int, float)) or isinstance(value, bool) or not value > 0.0:
            yield bad(LIMITS, f"{where}/{name}", f"It is {value!r}; a number above 0 in {unit} is needed.")


def topic_rows(record: RobotRecord, setup: Setup, listeners: Sequence[str]) -> List[Finding]:
    """Check the base's topics: types, rates, ages; its subscription; the frame of its odometry.

    Args:
        listeners: nodes that subscribe to the wheel command.
    """
    found = [each for each in topic_findings(record, setup) if each.subject in TOPICS]
    found.append(good(LISTENS, names.WHEEL_COMMAND, f"{', '.join(listeners)} takes it.") if listeners else
                 bad(LISTENS, names.WHEEL_COMMAND, "No node listens, 1 is needed: start the base, or name its topic "
                     "(wheel_command:=).", 0, 1))
    frames = sorted(record.topic(names.WHEEL_ODOMETRY).frames)
    if frames and frames != [names.ODOM]:
        found.append(bad(FRAMES, names.WHEEL_ODOMETRY, f"It comes in the frame {', '.join(frames)}; allowed is "
                         f"{names.ODOM}. Set the frame in the base's driver."))
    elif frames:
        found.append(good(FRAMES, names.WHEEL_ODOMETRY, f"It comes in the frame {names.ODOM}."))
    return found
