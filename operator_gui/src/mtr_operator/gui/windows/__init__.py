"""Windows of their own."""
# SPDX-License-Identifier: Apache-2.0
