"""Correctness of measured distances under disturbances: lines of a simulated world against its truth."""
# SPDX-License-Identifier: Apache-2.0
