"""Recorded bags: which files are bags of ROS 1, and why the others cannot be read."""
# SPDX-License-Identifier: Apache-2.0
