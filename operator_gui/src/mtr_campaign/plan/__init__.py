"""Plans: what is varied, in which design, and the runs that follow."""
# SPDX-License-Identifier: Apache-2.0
