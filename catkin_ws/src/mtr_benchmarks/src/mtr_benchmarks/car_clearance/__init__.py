"""Complete tests around random Cars that the LiDAR plane shows only in part, swept against their true bodies."""
# SPDX-License-Identifier: Apache-2.0
