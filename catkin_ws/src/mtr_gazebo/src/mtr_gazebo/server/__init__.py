"""Writes the world file of the robot that the parameters describe and becomes Gazebo's server."""
# SPDX-License-Identifier: Apache-2.0
