"""Fields in which the Operator types."""
# SPDX-License-Identifier: Apache-2.0
