#!/usr/bin/env bash
# Installs, upgrades or takes back the software of a robot (Ubuntu 20.04, ROS Noetic) and has systemd start it.
#
# Usage: sudo setup/install-robot.sh [--force] [--ros FOLDER] [--staging FOLDER]
#        sudo setup/install-robot.sh rollback [--force] [--staging FOLDER]
#        sudo setup/install-robot.sh jackal [--staging FOLDER]      a Jackal's base by mtr-base.service, not by its own ros.service
#        sudo setup/install-robot.sh hotspot NAME [--country CC] [PASSWORD]
#                                          without PASSWORD it is asked for, or read from the first line of the standard input
#
# Each release is a folder of its own, /opt/mtr/release-1, release-2 and so on. The link `current` names the one in use, and the link
# `former` in that one the one before it: one rename changes both, so that what fails or is cut off leaves both as they were.
# `rollback` goes back to the former release, and once more forth again; others are removed. --staging installs below a folder and
# touches neither packages nor services: for a try, and for images. docs/robot-setup.md leads from the box to the first test.
#
# While the robot's software runs, it is replaced only at standstill with a stop engaged. --force replaces software that does not answer.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
here=$top/setup/robot
# What mtr_bringup needs on a robot. The simulated world, rviz and what measures are not of it: the package.xml files name them for
# other computers only, by this word.
export MTR_ROLE=robot
packages=(catkin_ws/src/mtr_{car_locator,commissioning,controller_input,core,description,dispatcher,drive_control}
  catkin_ws/src/mtr_{fault_injection,graph_watch,jackal,localization,motion_check,motion_planner,msgs,peripherals,recording}
  catkin_ws/src/mtr_{serial_link,state_machine,surfel_map} launch proto)

fail() {
  echo "install-robot: $*" >&2
  exit 2
}

action=install
if [[ ${1:-} == rollback || ${1:-} == jackal || ${1:-} == hotspot ]]; then
  action=$1
  shift
fi
ros=/opt/ros/noetic
staging=
country=
force=
words=()
while (($#)); do
  case $1 in
    --country)
      [[ ${2:-} =~ ^[A-Z][A-Z]$ ]] || fail "--country needs two capital letters, DE for Germany."
      country=$2
      shift 2
      ;;
    --ros | --staging)
      (($# > 1)) || fail "$1 needs a folder."
      if [[ $1 == --ros ]]; then ros=$2; else staging=$(mkdir -p "$2" && cd "$2" && pwd); fi
      shift 2
      ;;
    --force) force=yes && shift ;;
    -*) fail "Option $1 is not known; allowed are --country, --force, --ros and --staging." ;;
    *) words+=("$1") && shift ;;
  esac
done
[[ $staging ]] || ((EUID == 0)) || fail "It has to be run as root: sudo setup/install-robot.sh"
[[ $action == hotspot ]] || ((${#words[@]} == 0)) || fail "The word ${words[0]} is not known; allowed are rollback, jackal and hotspot."
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

# The release in use judges its own robot: another one may not know its messages. One that has no `standstill` does not answer.
standstill() (
  set +eu
  program=$prefix/current/lib/mtr_commissioning/standstill
  # A release that is older has it there.
  [[ -x $program ]] || program=$prefix/current/lib/mtr_bringup/standstill
  [[ -x $program ]] || exit 3
  set -a
  # shellcheck source=/dev/null
  [[ ! -f $staging/etc/mtr/robot.env ]] || source "$staging/etc/mtr/robot.env"
  # shellcheck source=/dev/null
  source "$prefix/current/setup.bash"
  export ROS_HOME=/run/mtr-standstill ROS_LOG_DIR=/run/mtr-standstill
  exec timeout 30 "$program" 2>/dev/null
)

# A restart ends every node; a robot that moves, or that a person has not stopped, is not restarted.
require_standstill() {
  local sentence status=0
  [[ ! $staging ]] && systemctl is-active --quiet mtr-robot || return 0
  sentence=$(standstill) || status=$?
  case $status in
    0) ;;
    4) fail "$sentence The release in use stays." ;;
    *)
      [[ $force ]] || fail "The software of the robot does not answer, so the release in use stays; see that the robot stands, then" \
        "repeat this with --force."
      ;;
  esac
}

# What runs stays until the link points elsewhere; `mv -T` changes it in one step, and not before all is on the disk.
use() {
  local used
  require_standstill
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

# The base has programs of a release, too, where mtr-base.service brings it.
restart() {
  [[ ! $staging ]] || return 0
  systemctl try-restart mtr-base
  systemctl restart mtr-robot
}

install_packages() {
  [[ $staging ]] && return
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends build-essential iw nftables python3-catkin-tools python3-rosdep python3-spake2 \
    chrony >/dev/null
  [[ -d /etc/ros/rosdep/sources.list.d ]] || rosdep init
  rosdep update --rosdistro noetic >/dev/null
  # Not what only tests need, which are not built.
  rosdep install --from-paths "${packages[@]/#/$top/}" --ignore-src --rosdistro noetic -y \
    -t buildtool -t buildtool_export -t build -t build_export -t exec
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
  local units=$staging/etc/systemd/system
  put 755 start "$prefix/start"
  put 755 link "$prefix/link"
  put 644 jackal_base.launch "$prefix/jackal_base.launch"
  # Before what they bound.
  put 644 mtr-service.conf "$units/mtr-robot.service.d/mtr-service.conf"
  put 644 mtr-service.conf "$units/mtr-base.service.d/mtr-service.conf"
  put 644 mtr-robot.service "$units/mtr-robot.service"
  put 644 mtr-base.service "$units/mtr-base.service"
  put 755 tidy_logs "$prefix/tidy_logs"
  put 644 mtr-logs.service "$units/mtr-logs.service"
  put 644 mtr-logs.timer "$units/mtr-logs.timer"
  put 644 mtr.slice "$units/mtr.slice"
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

# Another value of a setting of the person's own.
set_setting() {
  local file=$staging/etc/mtr/robot.env
  grep -q "^$1=" "$file" || echo "$1=" >>"$file"
  sed "s|^$1=.*|$1=$2|" "$file" >"$file.new"
  mv -T "$file.new" "$file"
}

# A Jackal's own service would open the graph, command the wheels and describe another robot.
base_by_us() {
  set_setting MTR_LAUNCH jackal.launch
  set_setting MTR_MASTER wait
  [[ $staging ]] && return
  if systemctl cat ros >/dev/null 2>&1; then systemctl disable --quiet --now ros; fi
  systemctl daemon-reload
  systemctl enable --quiet mtr-base
  systemctl restart mtr-base mtr-robot
}

# NetworkManager's file of the access point, in which alone the password stands: a command's arguments are seen by everyone. A name is
# written by its bytes, a password with the signs that GLib's files reserve.
write_hotspot() {
  local uuid=$1 band=$2 ssid=$3 password=$4 file=$5
  ssid=$(od -An -v -tu1 <<<"$ssid" | tr -s ' \n' ';')
  # Without the end of the line, and without the first separator.
  ssid=${ssid%10;}
  password=${password//\\/\\\\}
  mkdir -p "${file%/*}"
  (
    umask 077
    printf '%s\n' "[connection]" "id=mtr-hotspot" "uuid=$uuid" "type=wifi" "" \
      "[wifi]" "mode=ap" "band=$band" "ssid=${ssid#;}" "" \
      "[wifi-security]" "key-mgmt=wpa-psk" "proto=rsn;" "pairwise=ccmp;" "psk=${password// /\\s}" "" \
      "[ipv4]" "method=shared" "address1=10.42.0.1/24" "" "[ipv6]" "method=disabled" >"$file"
  )
  nmcli connection load "$file" >/dev/null
}

# What NetworkManager forwards for its shared networks is dropped, from now on and before it at each start: the Wi-Fi leads to the robot
# and no farther. Without these rules no access point is begun.
close_forwarding() {
  command -v nft >/dev/null || fail "nft is missing; install nftables, without which the Wi-Fi would lead to the LiDARs."
  put 644 mtr-hotspot.nft "$staging/etc/mtr/mtr-hotspot.nft"
  put 644 mtr-hotspot.dnsmasq "$staging/etc/NetworkManager/dnsmasq-shared.d/mtr-hotspot.conf"
  put 644 mtr-hotspot.service "$staging/etc/systemd/system/mtr-hotspot.service"
  [[ ! $staging ]] || return 0
  systemctl daemon-reload
  systemctl enable --quiet mtr-hotspot
  systemctl restart mtr-hotspot || fail "The rules against forwarding could not be loaded; no access point was begun."
}

# Where no country is known no access point may begin to send at 5 GHz; the setting holds after a new start, too.
set_country() {
  [[ $country ]] || return 0
  mkdir -p "$staging/etc/modprobe.d"
  echo "options cfg80211 ieee80211_regdom=$country" >"$staging/etc/modprobe.d/mtr-country.conf"
  command -v iw >/dev/null || fail "iw is missing; install it, or leave --country away."
  iw reg set "$country"
}

# The access point of before goes when this one is up; --staging has its files elsewhere, nmcli is asked all the same.
hotspot() {
  local name=$1 password=$2 uuid file former each band
  command -v nmcli >/dev/null || fail "nmcli is missing; install network-manager."
  nmcli -t -f TYPE,STATE device | grep -E '^wifi:' | grep -qvE ':(unmanaged|unavailable)$' ||
    fail "NetworkManager has no Wi-Fi device; where netplan describes it, let it say renderer: NetworkManager."
  former=$(nmcli -t -f NAME,UUID connection show | sed -n 's/^mtr-hotspot://p')
  uuid=$(cat /proc/sys/kernel/random/uuid)
  file=$staging/etc/NetworkManager/system-connections/mtr-hotspot-$uuid.nmconnection
  close_forwarding
  set_country
  for band in a bg; do
    write_hotspot "$uuid" $band "$name" "$password" "$file"
    if nmcli connection up uuid "$uuid" >/dev/null; then
      for each in $former; do
        nmcli connection delete uuid "$each" >/dev/null
      done
      [[ $band == a ]] || echo "install-robot: no access point at 5 GHz; it is one at 2.4 GHz. Say --country, if you did not."
      echo "install-robot: the robot is 10.42.0.1 in the Wi-Fi $name; set bind_address:=10.42.0.1 in /etc/mtr/robot.env."
      return 0
    fi
  done
  rm -f "$file"
  nmcli connection reload
  for each in $former; do
    nmcli connection up uuid "$each" >/dev/null || true
  done
  fail "The access point could not be begun; the one of before stays."
}

case $action in
  install)
    alone
    # Before the build, which lasts minutes, and again before the release is used.
    require_standstill
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
  jackal)
    [[ -f $prefix/jackal_base.launch ]] || fail "Install the software first: sudo setup/install-robot.sh"
    require_standstill
    base_by_us
    echo "install-robot: mtr-base.service brings the base, jackal.launch the robot; back: systemctl disable --now mtr-base," \
      "systemctl enable --now ros."
    ;;
  hotspot)
    ((${#words[@]} == 1 || ${#words[@]} == 2)) || fail "hotspot needs a name, and takes a password."
    password=${words[1]:-}
    if ((${#words[@]} == 1)); then
      if [[ -t 0 ]]; then IFS= read -rsp "Password of the Wi-Fi ${words[0]}: " password && echo; else IFS= read -r password || true; fi
    fi
    ((${#password} >= 8 && ${#password} <= 63)) || fail "The password has ${#password} characters; allowed are 8 to 63."
    hotspot "${words[0]}" "$password"
    ;;
esac
