"""What runs one simulated test."""
# SPDX-License-Identifier: Apache-2.0
