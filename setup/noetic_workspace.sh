#!/usr/bin/env bash
# Proves the robot's packages on a machine like the robot: a clone in the src of an otherwise empty catkin workspace, and nothing
# installed but what the package.xml files declare. For ROS Noetic itself (image ros:noetic) and for Debian 11.
# Usage: noetic_workspace.sh prepare                   as root, before: compiler, rosdep, pip
#        noetic_workspace.sh WORKSPACE [PART...]       as a person who may use sudo; all parts or some of
#                                                      declared build unit gtest rostest drive, which are all, and gazebo
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
noetic=/opt/ros/noetic/setup.bash
tests="unit gtest rostest drive"

say() {
  echo "noetic: $*"
}

fail() {
  say "$*" >&2
  exit 2
}

prepare() {
  export DEBIAN_FRONTEND=noninteractive
  echo 'APT::Install-Recommends "false";' >/etc/apt/apt.conf.d/90noetic
  local rosdep=python3-rosdep2
  [[ ! -f $noetic ]] || rosdep=python3-rosdep
  apt-get update -qq
  apt-get install -y -qq build-essential python3-pip sudo "$rosdep" >/dev/null
  if [[ ! -f $noetic ]]; then debian_keys; fi
}

# rosdep's own lists know ROS's packages for Ubuntu only, so that those of Debian 11 are the only ones.
debian_keys() {
  local lists=/etc/ros/rosdep
  printf '%%YAML 1.1\n---\ndistributions: {}\ntype: index\nversion: 4\n' >$lists/no-index.yaml
  rm -f $lists/sources.list.d/*
  cp "$here/debian11-rosdep.yaml" $lists/
  echo "yaml file://$lists/debian11-rosdep.yaml" >$lists/sources.list.d/10-debian11.list
  # rosdep has no versions, and of MuJoCo the newest that pip finds has no wheel for Python 3.9; this one is tested everywhere.
  grep '^mujoco==' "$here/python-requirements.txt" >$lists/constraints.txt
  pip3 config --global set install.constraint $lists/constraints.txt >/dev/null
}

declared() {
  if [[ -f $noetic ]]; then
    [[ -d /etc/ros/rosdep/sources.list.d ]] || sudo rosdep init
  else
    export ROSDISTRO_INDEX_URL=file:///etc/ros/rosdep/no-index.yaml ROS_PYTHON_VERSION=3
  fi
  local before
  before=$(installed_packages)
  rosdep update >/dev/null
  sudo apt-get update -qq
  rosdep install --from-paths src --ignore-src -y >rosdep.log 2>&1 || { tail -30 rosdep.log; return 1; }
  # Debian 11's rospy calls what its Python 3.9 has no more; Noetic's has been mended.
  [[ -f $noetic ]] || sudo sed -i 's/\.isAlive()/.is_alive()/' /usr/lib/python3/dist-packages/rospy/core.py
  say "rosdep installed $(($(installed_packages) - before)) packages"
}

# The benchmark against Gazebo, with the Operator's application in an environment of its own: some of what that needs is newer than
# what Debian 11 has, and none of it is the robot's.
gazebo() {
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 9))' || fail "the Operator's application needs Python 3.9."
  sudo apt-get install -y -qq make python3-venv python3-pyqt5 python3-pyqt5.qtsvg >/dev/null
  [[ -d operator ]] || python3 -m venv --system-site-packages operator
  # What the application needs but the link's messages, which are the workspace's.
  sed -n '/^dependencies/,/^]/s/^ *"\(.*\)",/\1/p' "$here/../operator_gui/pyproject.toml" | grep -v '^mtr_proto$' >operator/needs.txt
  operator/bin/pip install -q --upgrade pip && operator/bin/pip install -q -r operator/needs.txt
  # shellcheck source=/dev/null
  set +u && source devel/setup.bash && set -u
  QT_QPA_PLATFORM=offscreen PATH=$PWD/operator/bin:$PATH make -C "$here/.." gazebo
}

installed_packages() {
  dpkg-query -W -f='${db:Status-Abbrev}\n' | grep -c '^ii'
}

build() {
  # Debian 11's cmake-extras has a GMock that catkin takes, and that links nothing; Noetic has none.
  catkin_make -j"${JOBS:-1}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_FIND_PACKAGE_GMock=TRUE >build.log 2>&1 || { tail -50 build.log; return 1; }
  say "$(g++ --version | head -1), $(python3 --version): the workspace is built"
}

# Does one part and says how long it took.
part() {
  local started=$SECONDS status=0
  if [[ " $tests " == *" $1 "* ]]; then
    # What was built decides where packages are found.
    # shellcheck source=/dev/null
    set +u && source devel/setup.bash && set -u
    python3 "$here/workspace_tests.py" "$PWD" "$1" || status=1
  else
    "$1"
  fi
  say "$1 took $((SECONDS - started)) s"
  return $status
}

if [[ ${1:-} == prepare ]]; then
  prepare
  exit
fi
cd "${1:?Say which workspace.}"
shift
# shellcheck disable=SC2086
(($#)) || set -- declared build $tests
if [[ -f $noetic ]]; then
  # shellcheck source=/dev/null
  set +u && source "$noetic" && set -u
fi
export ROS_IP=127.0.0.1 ROS_HOME=$PWD/ros OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
failed=0
for name in "$@"; do
  [[ " declared build $tests gazebo " == *" $name "* ]] ||
    fail "The part $name is none of: declared build $tests gazebo."
done
for name in "$@"; do
  if [[ " $tests " == *" $name "* ]]; then
    part "$name" || failed=1
  else
    # Without what is declared, or built, there is nothing to test: its failure ends the script.
    part "$name"
  fi
done
exit $failed
