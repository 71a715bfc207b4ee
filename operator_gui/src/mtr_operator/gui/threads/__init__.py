"""Work beside the window, which has to hear Stop meanwhile."""
# SPDX-License-Identifier: Apache-2.0
