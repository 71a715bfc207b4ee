"""The commands that deal with profiles of cars."""
# SPDX-License-Identifier: Apache-2.0
