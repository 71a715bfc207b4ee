"""A hand at the Car's handle, for all scenarios that have it taken."""
# SPDX-License-Identifier: Apache-2.0
