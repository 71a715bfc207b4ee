"""Is the robot put together and set up as its nodes take it to be? Only command_line and listening know ROS."""
# SPDX-License-Identifier: Apache-2.0
