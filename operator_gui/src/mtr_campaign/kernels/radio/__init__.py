"""The scenarios of the application on the radio of the simulated Car alone."""
# SPDX-License-Identifier: Apache-2.0
