"""Host side of rosserial: the topics and services of a board on a serial line in ROS."""
# SPDX-License-Identifier: Apache-2.0
