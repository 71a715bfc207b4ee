"""The journal of a test on disk: its file, where it goes on, where else it is kept, and who writes it meanwhile."""
# SPDX-License-Identifier: Apache-2.0
