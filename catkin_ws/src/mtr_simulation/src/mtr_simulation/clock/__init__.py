"""Conditions for which the simulated clock waits."""
# SPDX-License-Identifier: Apache-2.0
