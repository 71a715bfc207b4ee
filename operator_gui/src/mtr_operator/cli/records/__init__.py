"""Commands that recompute recorded tests, and prove their records."""
# SPDX-License-Identifier: Apache-2.0
