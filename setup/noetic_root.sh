#!/usr/bin/env bash
# Proves the robot's packages on the platform of ROS Noetic: noetic_workspace.sh in a Debian 11 (ROS 1, GCC 10, Python 3.9, Gazebo 11),
# the nearest that Debian has, or, with `container` as first word, in ros:noetic by podman or docker.
# Usage: noetic_root.sh [container] [PART...]           parts are those of noetic_workspace.sh, all of them by default
# Environment: KEEP, a folder in which the Debian 11 is kept, and taken up again by the next run; container does not use it.
# It says that it was skipped where neither can be had.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
proof=noetic-root
source "$(dirname "${BASH_SOURCE[0]}")/fresh_root.bash"
workspace=robot
clone=$workspace/src/mtr
image=ros:noetic

# One that answers; a client without its service is none.
engine() {
  local name
  for name in podman docker; do
    if command -v "$name" >/dev/null && $name info >/dev/null 2>&1; then
      echo "$name"
      return
    fi
  done
}

in_container() {
  local engine
  engine=$(engine)
  [[ $engine ]] || skip "no container engine answers"
  echo "$proof: $image by $engine at $(git -C "$top" rev-parse --short HEAD)"
  # The clone is made inside, so that nothing of this checkout is written.
  $engine run --rm --volume "$top:/checkout:ro" --env PARTS="$*" --env JOBS="${JOBS:-1}" "$image" bash -euo pipefail -c "
    apt-get update -qq && apt-get install -y -qq git >/dev/null
    /checkout/setup/noetic_workspace.sh prepare
    useradd --create-home --shell /bin/bash $person
    echo '$person ALL=(ALL) NOPASSWD: ALL' >/etc/sudoers.d/$person
    git config --system --add safe.directory '*'
    su $person -c 'cd && git clone -q /checkout $clone && $clone/setup/noetic_workspace.sh $workspace \$PARTS'"
}

if [[ ${1:-} == container ]]; then
  shift
  in_container "$@"
  exit
fi
isolate "$top/setup/noetic_root.sh" "$@"
make_root bullseye "${KEEP:-}"
# Nothing that is installed here starts a service on this machine.
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" && chmod 755 "$root/usr/sbin/policy-rc.d"
clone_for_person "$clone"
chroot "$root" "/home/$person/$clone/setup/noetic_workspace.sh" prepare
echo "$proof: Debian 11 at $(git -C "$top" rev-parse --short HEAD)"
as_person "JOBS=${JOBS:-1} $clone/setup/noetic_workspace.sh $workspace $*"
