"""Drives of the benchmark: what they are made of, recorded on the simulator's core, read back."""
# SPDX-License-Identifier: Apache-2.0
