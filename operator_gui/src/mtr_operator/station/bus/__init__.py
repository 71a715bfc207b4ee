"""What an engineer of the Car wants to see: its bus, and its locks beside the key's distance."""
# SPDX-License-Identifier: Apache-2.0
