"""Catkin reads the Python packages of mtr_car_locator from here."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

FOLDERS = ("find", "measure", "memory", "survey", "watch")
PACKAGES = ["mtr_car_locator", *(f"mtr_car_locator.{folder}" for folder in FOLDERS)]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
