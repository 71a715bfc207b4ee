"""The Operator's link with faults: a relay in front of its ports, and an Operator who should not be there."""
# SPDX-License-Identifier: Apache-2.0
