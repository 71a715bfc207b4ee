"""Robot's clock compared with its steady clock and with the laptop's: steps, simulation, offset."""
# SPDX-License-Identifier: Apache-2.0
