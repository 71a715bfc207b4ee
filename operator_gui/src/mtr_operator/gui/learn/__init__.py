"""The dialog in which a new car's profile is learned from its bus."""
# SPDX-License-Identifier: Apache-2.0
