"""Encryption and access control, for a link that another computer can reach. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import time
from typing import Callable, Optional, Tuple

from mtr_proto.keys import fingerprint

from ..parameters import Parameters
from .curve import Curve
from .gate import Gate
from .key_folder import FOLDER_NAME, KeyFolder


def admission(parameters: Parameters, home: pathlib.Path, inform: Callable[[str], None],
              warn: Callable[[str], None]) -> Tuple[Optional[Curve], Optional[Gate]]:
    """Return the robot's keys and the gate for paired keys, or None for both on a link without encryption.

    home: parent of the key folder, unless the parameters name one. inform, warn: receive sentences for the log.
    """
    if not parameters.is_encrypted:
        if parameters.is_exposed:
            warn("The link is not encrypted (allow_unencrypted): "
                 f"whoever reaches {parameters.bind_address} can move the robot.")
        return None, None
    folder = KeyFolder(pathlib.Path(parameters.key_folder or home / FOLDER_NAME))
    gate = Gate(folder.authorised, parameters.max_commands_per_s, time.monotonic, lambda: folder.distrust)
    curve = Curve(folder.own_keys(), gate.admits)
    keys = folder.authorised()
    if folder.distrust:
        warn(folder.distrust)
    inform(f"The link is encrypted; {len(keys.entries)} keys are paired. This robot's key: "
           f"{fingerprint(curve.keys.public.decode('ascii'))}")
    return curve, gate
