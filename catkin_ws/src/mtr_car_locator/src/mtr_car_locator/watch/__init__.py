"""The Car seen again: whether it still stands where it was measured."""
# SPDX-License-Identifier: Apache-2.0
