"""Sphinx's settings for the API pages of the Python packages; `make docs` writes the list of modules beside a copy."""
# SPDX-License-Identifier: Apache-2.0
import mtr_operator

project = "Mobile testing robot, Python"
copyright = "its maintainers, Apache-2.0"
release = mtr_operator.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "alabaster"
autodoc_default_options = {"members": True, "undoc-members": True, "show-inheritance": True}
autodoc_typehints = "description"
# Only a game controller's driver needs it, and it needs a kernel's headers.
autodoc_mock_imports = ["evdev"]
