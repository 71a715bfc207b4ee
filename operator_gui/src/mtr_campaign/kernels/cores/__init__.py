"""Kernel with the application's scenarios and all node cores of the robot in one process."""
# SPDX-License-Identifier: Apache-2.0
