"""What presses at places around the Car say of the probability that the Car reacts there."""
# SPDX-License-Identifier: Apache-2.0
