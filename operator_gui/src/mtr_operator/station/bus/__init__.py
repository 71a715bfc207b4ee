"""Live view of the Car's bus, and of its locks with the key's distance."""
# SPDX-License-Identifier: Apache-2.0
