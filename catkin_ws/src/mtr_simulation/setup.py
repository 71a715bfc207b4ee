"""Python packages of mtr_simulation for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

FOLDERS = ("car", "car.honest", "car.honest.radio", "car.reaction", "clock", "cores", "firmware", "physics", "sensors",
           "site", "truth")

setup(**generate_distutils_setup(
    packages=["mtr_simulation", *(f"mtr_simulation.{folder}" for folder in FOLDERS)],
    package_dir={"": "src"}, package_data={"mtr_simulation.car": ["*.dbc", "cars/*.yaml", "honest/*.dbc"]}))
