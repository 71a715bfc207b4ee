"""How steeply a beam has to meet a surface for its return to count: cosines between beam and normal."""
# SPDX-License-Identifier: Apache-2.0

# At more than 75 degrees from the normal the LiDAR's spot is long, and what it shows is the smeared edge of something.
MIN_INCIDENCE_COSINE = 0.25
# A tyre's face ends where its returns get sparse; of those only what is within 73 degrees counts.
MIN_TYRE_INCIDENCE_COSINE = 0.3
