"""The disks that the robot writes to: required free space, and detection of a full disk."""
# SPDX-License-Identifier: Apache-2.0
