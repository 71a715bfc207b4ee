"""Cost of the link's encryption."""
# SPDX-License-Identifier: Apache-2.0
