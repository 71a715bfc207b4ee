#!/usr/bin/env bash
# Installs, upgrades or takes back the software of a robot (Ubuntu 20.04, ROS Noetic) and has systemd start it.
#
# Usage: sudo setup/install-robot.sh [--ros FOLDER] [--staging FOLDER]
#        sudo setup/install-robot.sh rollback [--staging FOLDER]
#        sudo setup/install-robot.sh hotspot NAME PASSWORD
#
# Two releases are kept, /opt/mtr/a and /opt/mtr/b; `current` is the one in use. The other one is built anew, and only when it
# is complete it comes into use; `rollback` changes back. --staging installs below a folder and touches neither packages nor
# services: for a try, and for images. docs/robot-setup.md leads from the box to the first test.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
here=$top/setup/robot
# Not on a robot: the simulated world, and what measures.
not_needed="mtr_benchmarks mtr_gazebo mtr_rviz mtr_tests"

fail() {
  echo "install-robot: $*" >&2
  exit 2
}

action=install
if [[ ${1:-} == rollback || ${1:-} == hotspot ]]; then
  action=$1
  shift
fi
ros=/opt/ros/noetic
staging=
words=()
while (($#)); do
  case $1 in
    --ros | --staging)
      (($# > 1)) || fail "$1 needs a folder."
      if [[ $1 == --ros ]]; then ros=$2; else staging=$(mkdir -p "$2" && cd "$2" && pwd); fi
      shift 2
      ;;
    -*) fail "Option $1 is not known; allowed are --ros and --staging." ;;
    *) words+=("$1") && shift ;;
  esac
done
[[ $staging ]] || ((EUID == 0)) || fail "It has to be run as root: sudo setup/install-robot.sh"
[[ $action == hotspot ]] || ((${#words[@]} == 0)) || fail "The word ${words[0]} is not known; allowed are rollback and hotspot."
prefix=$staging/opt/mtr

# What runs stays until the link points elsewhere; `ln -T` and `mv` change it in one step.
use() {
  ln -sfnT "$1" "$prefix/next" && mv -T "$prefix/next" "$prefix/current"
  echo "install-robot: release $1 is in use ($(cat "$prefix/$1/release"))."
}

other_release() {
  if [[ $(readlink "$prefix/current" 2>/dev/null) == a ]]; then echo b; else echo a; fi
}

restart() {
  [[ $staging ]] || systemctl restart mtr-robot
}

install_packages() {
  [[ $staging ]] && return
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends build-essential python3-catkin-tools python3-rosdep python3-spake2 \
    chrony logrotate >/dev/null
  [[ -d /etc/ros/rosdep/sources.list.d ]] || rosdep init
  rosdep update --rosdistro noetic >/dev/null
  rosdep install --from-paths "$top" --ignore-src --rosdistro noetic -y --skip-keys "$not_needed gazebo_dev"
}

build() {
  local release=$1
  rm -rf "${prefix:?}/$release" "$prefix/build"
  mkdir -p "$prefix/build/src"
  ln -s "$top" "$prefix/build/src/mtr"
  if [[ -f $ros/setup.bash ]]; then
    # shellcheck source=/dev/null
    set +u && source "$ros/setup.bash" && set -u
  elif [[ ! -d /usr/share/catkin ]]; then
    fail "$ros has no setup.bash; install ROS Noetic first, or say with --ros where it is."
  fi
  (
    cd "$prefix/build"
    catkin config --init --install --install-space "$prefix/$release" --skiplist $not_needed \
      --cmake-args -DCMAKE_BUILD_TYPE=Release -DCATKIN_ENABLE_TESTING=OFF >/dev/null
    catkin build --no-status --summary
  )
  git -c safe.directory="$top" -C "$top" describe --always --dirty >"$prefix/$release/release"
  rm -rf "$prefix/build"
}

install_files() {
  install -D -m 755 "$here/start" "$prefix/start"
  install -D -m 755 "$here/link" "$prefix/link"
  install -D -m 644 "$here/mtr-robot.service" "$staging/etc/systemd/system/mtr-robot.service"
  install -D -m 644 "$here/mtr-robot.logrotate" "$staging/etc/logrotate.d/mtr-robot"
  # The person's own settings outlive an upgrade.
  [[ -f $staging/etc/mtr/robot.env ]] || install -D -m 644 "$here/robot.env" "$staging/etc/mtr/robot.env"
}

enable_service() {
  [[ $staging ]] && return
  id mtr >/dev/null 2>&1 || useradd --system --no-create-home --home-dir /var/lib/mtr --shell /usr/sbin/nologin mtr
  systemctl daemon-reload
  systemctl enable --quiet mtr-robot
}

case $action in
  install)
    release=$(other_release)
    install_packages
    build "$release"
    install_files
    enable_service
    use "$release"
    restart
    ;;
  rollback)
    release=$(other_release)
    [[ -f $prefix/$release/setup.bash ]] || fail "There is no former release to go back to."
    use "$release"
    restart
    ;;
  hotspot)
    ((${#words[@]} == 2)) || fail "hotspot needs a name and a password."
    ((${#words[1]} >= 8 && ${#words[1]} <= 63)) || fail "The password has ${#words[1]} characters; allowed are 8 to 63."
    command -v nmcli >/dev/null || fail "nmcli is missing; install network-manager."
    nmcli connection delete mtr-hotspot >/dev/null 2>&1 || true
    nmcli connection add type wifi ifname '*' con-name mtr-hotspot autoconnect yes ssid "${words[0]}" \
      802-11-wireless.mode ap 802-11-wireless.band a ipv4.method shared ipv4.addresses 10.42.0.1/24 ipv6.method disabled \
      wifi-sec.key-mgmt wpa-psk wifi-sec.proto rsn wifi-sec.pairwise ccmp wifi-sec.psk "${words[1]}" >/dev/null
    nmcli connection up mtr-hotspot >/dev/null
    echo "install-robot: the robot is 10.42.0.1 in the Wi-Fi ${words[0]}; set bind_address:=10.42.0.1 in /etc/mtr/robot.env."
    ;;
esac
