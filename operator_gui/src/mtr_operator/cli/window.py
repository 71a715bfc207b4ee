"""Command that opens the window."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import os
import sys
from typing import Any, Mapping

from mtr_operator.doctor.computer import display_problem
from mtr_operator.domain.errors import OperatorError

# Options of the command line by the name of their field.
_ROBOT = {"host": "robot", "subscriber_port": "subscriber_port", "publisher_port": "publisher_port",
          "is_unencrypted": "unencrypted"}
_CAN = {"interface": "can_interface", "channel": "can_channel", "bitrate_bps": "can_bitrate", "profile": "car_profile",
        "is_normal": "can_normal", "data_bitrate_bps": "can_data_bitrate"}
_SUBSTITUTE = {"car_seed": "car_seed"}


def open_window(options: argparse.Namespace) -> int:
    """Run the window until it is closed; return the exit code."""
    try:
        from mtr_operator.gui.app import run
    except ModuleNotFoundError as error:
        if error.name is None or not error.name.startswith("PyQt5"):
            raise
        raise OperatorError("The window needs PyQt5, which is not installed; pip install PyQt5, or use the command "
                            "run.") from None
    _check_display(os.environ, sys.platform)
    return run(_given(options, _ROBOT), _given(options, _CAN), **_given(options, _SUBSTITUTE))


def _check_display(environment: Mapping[str, str], platform: str) -> None:
    problem = display_problem(environment, platform)
    if problem:
        raise OperatorError(problem)


def _given(options: argparse.Namespace, names: dict[str, str]) -> dict[str, Any]:
    found = {name: getattr(options, option, None) for name, option in names.items()}
    return {name: value for name, value in found.items() if value is not None}
