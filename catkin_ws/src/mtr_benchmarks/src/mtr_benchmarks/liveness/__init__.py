"""Stops nodes and sets the clock of the complete robot on the machine's clock."""
# SPDX-License-Identifier: Apache-2.0
