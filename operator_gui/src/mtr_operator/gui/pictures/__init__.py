"""Car, robot and results from above, painted alike on screen and in files."""
# SPDX-License-Identifier: Apache-2.0
