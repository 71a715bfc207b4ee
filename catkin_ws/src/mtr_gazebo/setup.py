"""Catkin reads the Python packages of mtr_gazebo from here."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

FOLDERS = ("equipment", "server", "world")

setup(**generate_distutils_setup(
    packages=["mtr_gazebo", *(f"mtr_gazebo.{folder}" for folder in FOLDERS)], package_dir={"": "src"}))
