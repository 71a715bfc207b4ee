"""Drives of the benchmark: their composition, recording on the simulator's core, and reading."""
# SPDX-License-Identifier: Apache-2.0
