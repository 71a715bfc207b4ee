"""What a laboratory keeps of a test: one signed file with all of it, and the proof that nothing in it was changed."""
# SPDX-License-Identifier: Apache-2.0
