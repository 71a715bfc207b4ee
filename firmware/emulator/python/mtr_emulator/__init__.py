"""Starts and drives the emulated board of the peripherals."""
# SPDX-License-Identifier: Apache-2.0
from .emulator import Emulator, EmulatorError, Probe

__all__ = ["Emulator", "EmulatorError", "Probe"]
