"""Pages about tests: pictures as SVG, and HTML from one set of templates, for files and for the browser."""
# SPDX-License-Identifier: Apache-2.0
