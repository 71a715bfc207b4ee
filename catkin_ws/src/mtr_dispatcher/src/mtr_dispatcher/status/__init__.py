"""Contents of a Status."""
# SPDX-License-Identifier: Apache-2.0
