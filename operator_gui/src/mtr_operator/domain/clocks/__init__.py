"""The robot's clock beside its steady one and the laptop's: set, simulated, apart."""
# SPDX-License-Identifier: Apache-2.0
