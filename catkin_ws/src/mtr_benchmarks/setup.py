"""Catkin reads the Python packages of mtr_benchmarks from here."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

PACKAGES = ["mtr_benchmarks", "mtr_benchmarks.components", "mtr_benchmarks.localization", "mtr_benchmarks.motion"]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
