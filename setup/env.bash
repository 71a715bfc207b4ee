# Environment for everything that runs in this checkout: the workspace, the virtual environment, ROS on loopback only.
# SPDX-License-Identifier: Apache-2.0
_top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export PATH="$_top/.venv/bin:/usr/bin:$PATH"
unset PYTHONHOME PYENV_VERSION
# Catkin's own script reads variables that may be unset.
_options=$-
set +eu
# shellcheck disable=SC1091
[ -f "$_top/catkin_ws/devel/setup.bash" ] && source "$_top/catkin_ws/devel/setup.bash"
[[ $_options != *e* ]] || set -e
[[ $_options != *u* ]] || set -u
# The firmware's emulator is no catkin package.
export PYTHONPATH="$_top/firmware/emulator/python${PYTHONPATH:+:$PYTHONPATH}"
export ROS_PACKAGE_PATH="$_top/catkin_ws/src:$_top/launch:$_top/proto:$_top/tests:/usr/share"
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://127.0.0.1:11311}"
export ROS_IP=127.0.0.1
export ROS_HOME="$_top/out/ros"
unset _top _options
