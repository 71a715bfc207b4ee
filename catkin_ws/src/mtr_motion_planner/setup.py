"""Declares the Python packages of mtr_motion_planner for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

PACKAGES = ["mtr_motion_planner",
            *(f"mtr_motion_planner.{folder}" for folder in ("following", "geometry", "search", "timing"))]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
