"""Readers of textual logs of a bus: one for each kind of line."""
# SPDX-License-Identifier: Apache-2.0
