"""What a test keeps: results of its lines, the Car's frames, and what the protocol shows."""
# SPDX-License-Identifier: Apache-2.0
