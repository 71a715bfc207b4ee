"""Identity and signature in a report."""
# SPDX-License-Identifier: Apache-2.0
