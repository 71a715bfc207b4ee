"""The event list on the screen."""
# SPDX-License-Identifier: Apache-2.0
