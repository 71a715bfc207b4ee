"""Steepest accepted incidence of beams, as cosines between beam and normal."""
# SPDX-License-Identifier: Apache-2.0

# At more than 75 degrees from the normal, the LiDAR's spot is long and smears edges.
MIN_INCIDENCE_COSINE = 0.25
# A tyre's face ends where its returns become sparse, so only returns within 73 degrees count.
MIN_TYRE_INCIDENCE_COSINE = 0.3
