"""Identity of a test: the part of its record that comes from people instead of sensors."""
# SPDX-License-Identifier: Apache-2.0
