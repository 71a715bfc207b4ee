#!/usr/bin/env bash
# Builds the catkin workspace (the proto is one of its packages) with the virtual environment's Python.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD

# The workspace must not chain to a ROS that the person happened to source.
unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH
export PATH="/usr/bin:$PATH"

cd catkin_ws
catkin config --init --cmake-args "-DPYTHON_EXECUTABLE=$top/.venv/bin/python" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -Wno-dev --no-warn-unused-cli >/dev/null
mkdir -p "$top/.setup"
log=$top/.setup/build.log
echo "Building the workspace"
if ! catkin build --no-status --no-notify -j2 >"$log" 2>&1; then
  cat "$log"
  exit 1
fi

# The Operator's application as `mtr-operator`, straight from its folder.
cd "$top"
.venv/bin/pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps -e operator_gui
