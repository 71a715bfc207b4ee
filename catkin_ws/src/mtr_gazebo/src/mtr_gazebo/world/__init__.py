"""Conversion of a scenario and a URDF to a world file; no ROS."""
# SPDX-License-Identifier: Apache-2.0
