"""What is recorded with a test beside its progress: the log of the bus, and the course."""
# SPDX-License-Identifier: Apache-2.0
