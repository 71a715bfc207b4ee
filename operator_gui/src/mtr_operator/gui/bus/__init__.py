"""The live view of the Car's bus: its messages, and the locks beside the key's distance."""
# SPDX-License-Identifier: Apache-2.0
