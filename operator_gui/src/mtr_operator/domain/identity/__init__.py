"""Who measured what, with what: the part of a test's record that no sensor tells."""
# SPDX-License-Identifier: Apache-2.0
