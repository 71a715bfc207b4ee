"""The application's scenarios on the cores of the whole robot, in one process."""
# SPDX-License-Identifier: Apache-2.0
