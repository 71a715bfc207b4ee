"""Distances of a test computed anew, from what was recorded with it: log of the bus, poses, profile."""
# SPDX-License-Identifier: Apache-2.0
