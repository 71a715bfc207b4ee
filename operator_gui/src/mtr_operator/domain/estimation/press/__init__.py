"""Key press: the distances at which 50 and 95 % of the presses work, and where to press next."""
# SPDX-License-Identifier: Apache-2.0
