"""Is the ROS graph closed: do its master and nodes listen on loopback only? Asked at the start and ever after."""
# SPDX-License-Identifier: Apache-2.0
