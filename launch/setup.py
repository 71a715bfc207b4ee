"""Catkin reads the Python packages of mtr_bringup from here."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

PACKAGES = ["mtr_bringup", "mtr_bringup.base_contract", "mtr_bringup.base_stop", "mtr_bringup.calibration",
            "mtr_bringup.calibration.balance", "mtr_bringup.cores", "mtr_bringup.graph_watch", "mtr_bringup.preflight",
            "mtr_bringup.preflight.motion", "mtr_bringup.recording", "mtr_bringup.standstill"]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
