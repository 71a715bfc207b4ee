"""Declares the Python packages of mtr_commissioning for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

FOLDERS = ("base_contract", "calibration", "calibration.balance", "preflight", "standstill")

setup(**generate_distutils_setup(
    packages=["mtr_commissioning", *(f"mtr_commissioning.{folder}" for folder in FOLDERS)], package_dir={"": "src"}))
