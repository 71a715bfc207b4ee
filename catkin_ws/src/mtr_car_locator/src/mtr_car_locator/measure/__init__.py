"""The found Car's pose, size and outline, each with its uncertainty."""
# SPDX-License-Identifier: Apache-2.0
