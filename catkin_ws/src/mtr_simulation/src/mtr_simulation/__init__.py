"""Simulated robot, its world and the Car, with a core without ROS."""
# SPDX-License-Identifier: Apache-2.0
