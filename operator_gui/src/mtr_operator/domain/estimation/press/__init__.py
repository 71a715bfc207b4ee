"""Key press: distances at which 50 and 95 % of the presses work, and the selection of the next press."""
# SPDX-License-Identifier: Apache-2.0
