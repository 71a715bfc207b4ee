"""What goes into a Status."""
# SPDX-License-Identifier: Apache-2.0
