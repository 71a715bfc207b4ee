"""Checks the running robot against the assumptions of its nodes. Only command_line and listening import ROS."""
# SPDX-License-Identifier: Apache-2.0
