#!/usr/bin/env bash
# API pages of every Python package and C++ library in out/docs, from their docstrings and comments.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
rm -rf out/docs
mkdir -p out/docs/source

doxygen docs/api/Doxyfile

cp docs/api/conf.py docs/api/index.rst out/docs/source
for folder in catkin_ws/src/*/src/mtr_* operator_gui/src/mtr_* firmware/emulator/python/mtr_*; do
  if [[ -d $folder ]]; then
    python -m sphinx.ext.apidoc -q --no-toc --module-first --output-dir out/docs/source/modules "$folder"
  fi
done
python -m sphinx -Q -j auto -b html out/docs/source out/docs/python
echo "API pages: out/docs/python/index.html, out/docs/cpp/index.html"
