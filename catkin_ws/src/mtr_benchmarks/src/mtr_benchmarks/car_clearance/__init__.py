"""Whole tests around random Cars of which the LiDARs' plane shows only a part, swept against their true bodies."""
# SPDX-License-Identifier: Apache-2.0
