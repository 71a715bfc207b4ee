"""Whether what was measured keeps the limits that the Operator gave: Pass, Inconclusive or Fail."""
# SPDX-License-Identifier: Apache-2.0
