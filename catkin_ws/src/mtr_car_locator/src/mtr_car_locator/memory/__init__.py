"""Storage of the located Car in a file, from which a restarted locator resumes."""
# SPDX-License-Identifier: Apache-2.0
