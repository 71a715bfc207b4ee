"""What encryption costs the link."""
# SPDX-License-Identifier: Apache-2.0
