"""What has to be right before the robot moves, item by item."""
# SPDX-License-Identifier: Apache-2.0
