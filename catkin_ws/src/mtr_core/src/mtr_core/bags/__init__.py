"""Recorded bags: detection of ROS 1 bags, and diagnosis of other files."""
# SPDX-License-Identifier: Apache-2.0
