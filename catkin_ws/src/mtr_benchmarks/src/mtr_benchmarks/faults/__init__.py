"""Matrix of states and faults, run on the simulated robot."""
# SPDX-License-Identifier: Apache-2.0
