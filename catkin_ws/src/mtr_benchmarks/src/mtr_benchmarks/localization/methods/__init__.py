"""What this system and two others make of a recorded drive."""
# SPDX-License-Identifier: Apache-2.0
