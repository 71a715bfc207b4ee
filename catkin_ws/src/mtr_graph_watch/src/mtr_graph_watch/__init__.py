"""Checks that master and nodes of the ROS graph listen on loopback only, at the start and continuously."""
# SPDX-License-Identifier: Apache-2.0
