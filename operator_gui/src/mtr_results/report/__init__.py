"""Pages about tests: SVG pictures, and HTML templates for files and for the browser."""
# SPDX-License-Identifier: Apache-2.0
