#!/usr/bin/env bash
# Builds the catkin workspace (the proto is one of its packages) with the virtual environment's Python.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD

# The workspace must not chain to a ROS that the person happened to source.
unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH
export PATH="/usr/bin:$PATH"

# The packages lie in several folders of the checkout, so its top is the source space; what was built or written is none.
if grep -qsx "source_space: $top/catkin_ws/src" catkin_ws/build/.catkin_tools.yaml; then
  # Built by an older version of the project from another source space, which catkin refuses to mix.
  rm -rf catkin_ws/{build,devel,logs}
fi
mkdir -p out catkin_ws/{build,devel,logs} .setup
touch {out,catkin_ws/build,catkin_ws/devel,catkin_ws/logs}/CATKIN_IGNORE
cd catkin_ws
catkin config --init --source-space .. --cmake-args "-DPYTHON_EXECUTABLE=$top/.venv/bin/python" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -Wno-dev --no-warn-unused-cli >/dev/null
log=$top/.setup/build.log
echo "Building the workspace"
if ! catkin build --no-status --no-notify -j2 >"$log" 2>&1; then
  cat "$log"
  exit 1
fi

# The Operator's application as `mtr-operator`, straight from its folder.
cd "$top"
.venv/bin/pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps -e operator_gui
