"""Recomputes the distances of a test from its recording: log of the bus, poses, profile."""
# SPDX-License-Identifier: Apache-2.0
