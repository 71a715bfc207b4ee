#!/usr/bin/env bash
# Installs, upgrades or takes back the software of a robot (Ubuntu 20.04, ROS Noetic) and has systemd start it.
#
# Usage: sudo setup/install-robot.sh [--ros FOLDER] [--staging FOLDER]
#        sudo setup/install-robot.sh rollback [--staging FOLDER]
#        sudo setup/install-robot.sh hotspot NAME PASSWORD
#
# Each release is a folder of its own, /opt/mtr/release-1, release-2 and so on. The link `current` names the one in use, and the link
# `former` in that one the one before it: one rename changes both, so that what fails or is cut off leaves both as they were.
# `rollback` goes back to the former release, and once more forth again; others are removed. --staging installs below a folder and
# touches neither packages nor services: for a try, and for images. docs/robot-setup.md leads from the box to the first test.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
here=$top/setup/robot
# What mtr_bringup needs on a robot. The simulated world, rviz and what measures are not of it: the package.xml files name them for
# other computers only, by this word.
export MTR_ROLE=robot
packages=(launch proto catkin_ws/src/mtr_{car_locator,controller_input,core,description,dispatcher,drive_control}
  catkin_ws/src/mtr_{fault_injection,localization,motion_planner,msgs,peripherals,serial_link,state_machine,surfel_map})

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

in_use() {
  readlink "$prefix/current" || true
}

# The release that was in use before this one; nothing where there is none that is whole: its file `release` is written last.
former() {
  local link
  link=$(readlink "$prefix/current/former") || return 0
  link=${link#../}
  [[ ! -f $prefix/$link/release ]] || echo "$link"
}

# There were two folders, a and b, once, and the one that was not in use was the former one.
adopt_letters() {
  local used other
  used=$(in_use)
  case $used in a) other=b ;; b) other=a ;; *) return 0 ;; esac
  if [[ ! -L $prefix/$used/former && -f $prefix/$other/release ]]; then
    ln -sT "../$other" "$prefix/$used/former"
  fi
}

# What runs stays until the link points elsewhere; `mv -T` changes it in one step, and not before all is on the disk.
use() {
  local used
  used=$(in_use)
  if [[ $used && $used != "$1" ]]; then ln -sfnT "../$used" "$prefix/$1/former"; fi
  ln -sfnT "$1" "$prefix/next"
  sync -f "$prefix"
  mv -T "$prefix/next" "$prefix/current"
  echo "install-robot: release $1 is in use ($(cat "$prefix/$1/release"))."
}

remove_unused() {
  local used kept folder
  used=$(in_use)
  kept=$(former)
  for folder in "$prefix"/{a,b,build,release-*}; do
    case ${folder##*/} in "$used" | "$kept") ;; *) rm -rf "$folder" ;; esac
  done
}

new_release() {
  local folder number last=0
  for folder in "$prefix"/release-*; do
    number=${folder##*-}
    if [[ $number =~ ^[0-9]+$ && $number -gt $last ]]; then last=$number; fi
  done
  echo "release-$((last + 1))"
}

# A connection that breaks leaves an installation running, which a second one must not disturb.
alone() {
  mkdir -p "$prefix"
  exec 9>"$prefix/lock"
  flock --nonblock 9 || fail "Another installation is running."
}

restart() {
  [[ $staging ]] || systemctl restart mtr-robot
}

install_packages() {
  [[ $staging ]] && return
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends build-essential python3-catkin-tools python3-rosdep python3-spake2 \
    chrony >/dev/null
  [[ -d /etc/ros/rosdep/sources.list.d ]] || rosdep init
  rosdep update --rosdistro noetic >/dev/null
  # Not what only tests need, which are not built.
  rosdep install --from-paths "${packages[@]/#/$top/}" --ignore-src --rosdistro noetic -y \
    --dependency-types "buildtool buildtool_export build build_export exec"
}

build() {
  local release=$1 commit
  commit=$(git -c safe.directory="$top" -C "$top" describe --always --dirty)
  mkdir -p "$prefix/build/src"
  ln -s "${packages[@]/#/$top/}" "$prefix/build/src"
  if [[ -f $ros/setup.bash ]]; then
    # shellcheck source=/dev/null
    set +u && source "$ros/setup.bash" && set -u
  elif [[ ! -d /usr/share/catkin ]]; then
    fail "$ros has no setup.bash; install ROS Noetic first, or say with --ros where it is."
  fi
  (
    cd "$prefix/build"
    catkin config --init --install --install-space "$prefix/$release" \
      --cmake-args -DCMAKE_BUILD_TYPE=Release -DCATKIN_ENABLE_TESTING=OFF >/dev/null
    catkin build --no-status --summary
  )
  echo "$commit" >"$prefix/$release/release"
}

# A file is there as it was or as it will be, never half of it.
put() {
  install -D -m "$1" "$here/$2" "$3.new"
  mv -T "$3.new" "$3"
}

install_files() {
  put 755 start "$prefix/start"
  put 755 link "$prefix/link"
  put 644 mtr-robot.service "$staging/etc/systemd/system/mtr-robot.service"
  put 755 tidy_logs "$prefix/tidy_logs"
  put 644 mtr-logs.service "$staging/etc/systemd/system/mtr-logs.service"
  put 644 mtr-logs.timer "$staging/etc/systemd/system/mtr-logs.timer"
  # Of earlier installations; it never removed what an ended run had left.
  rm -f "$staging/etc/logrotate.d/mtr-robot"
  # The person's own settings outlive an upgrade.
  [[ -f $staging/etc/mtr/robot.env ]] || put 644 robot.env "$staging/etc/mtr/robot.env"
}

# Chrony 4 reads this folder by its own settings; Ubuntu 20.04's chrony 3 has to be told.
share_clock() {
  local settings=$staging/etc/chrony/chrony.conf
  put 644 mtr-robot.chrony "$staging/etc/chrony/conf.d/mtr-robot.conf"
  if [[ -f $settings ]] && ! grep -qE '^(confdir|include) .*/etc/chrony/conf\.d' "$settings"; then
    printf '\n# Added by install-robot.sh\ninclude /etc/chrony/conf.d/*.conf\n' >>"$settings"
  fi
}

enable_service() {
  [[ $staging ]] && return
  id mtr >/dev/null 2>&1 || useradd --system --no-create-home --home-dir /var/lib/mtr --shell /usr/sbin/nologin mtr
  systemctl daemon-reload
  systemctl enable --quiet mtr-robot
  systemctl enable --quiet --now mtr-logs.timer
  systemctl restart chrony
}

case $action in
  install)
    alone
    adopt_letters
    remove_unused
    release=$(new_release)
    trap remove_unused EXIT
    install_packages
    build "$release"
    install_files
    share_clock
    enable_service
    use "$release"
    restart
    ;;
  rollback)
    alone
    adopt_letters
    release=$(former)
    [[ $release ]] || fail "There is no former release to go back to."
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
