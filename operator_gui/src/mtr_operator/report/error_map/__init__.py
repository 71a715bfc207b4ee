"""Maps of errors on the protocol."""
# SPDX-License-Identifier: Apache-2.0
