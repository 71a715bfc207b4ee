"""Figures over many drives, and the rows of the table."""
# SPDX-License-Identifier: Apache-2.0
