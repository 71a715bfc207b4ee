"""Probability that a Car reacts to a key at rest at a place, computed from its model."""
# SPDX-License-Identifier: Apache-2.0
