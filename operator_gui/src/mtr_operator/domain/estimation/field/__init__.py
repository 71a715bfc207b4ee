"""Probability of a reaction of the Car around it, estimated from presses."""
# SPDX-License-Identifier: Apache-2.0
