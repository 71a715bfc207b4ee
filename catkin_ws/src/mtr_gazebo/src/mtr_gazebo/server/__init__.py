"""Writes the world file of the robot and starts Gazebo's server."""
# SPDX-License-Identifier: Apache-2.0
