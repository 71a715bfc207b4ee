"""What the application switches at the Car by messages on its bus: its handle, an extender."""
# SPDX-License-Identifier: Apache-2.0
