"""Ground truth of the simulated Car's events, and its comparison with measured results."""
# SPDX-License-Identifier: Apache-2.0
