#!/usr/bin/env bash
# Runs make targets in a Debian 12 that holds nothing but git, make and sudo, on a fresh clone of this checkout's commit.
# Usage: bare_root.sh [TARGET...]   (default: test); it says that it was skipped where no such root can be made.
# What is not committed is not in the clone. apt's mirror and pip's settings are those of this machine, read at run time.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
release=bookworm
person=developer

skip() {
  echo "bare-root: skipped, $1"
  exit 0
}

# Mounts and processes live in namespaces of their own, so that both end with this script.
if [[ ${BARE_ROOT_ISOLATED:-} != yes ]]; then
  ((EUID == 0)) || skip "it needs root"
  for program in debootstrap unshare chroot; do
    command -v "$program" >/dev/null || skip "$program is missing"
  done
  unshare --mount --pid --fork true 2>/dev/null || skip "this machine grants no namespaces"
  exec env BARE_ROOT_ISOLATED=yes unshare --mount --pid --fork --kill-child "$top/setup/bare_root.sh" "$@"
fi
(($#)) || set -- test

sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(CODENAME) main' 'Created-By: Packages' 'Component: main' \
  | grep -E " $release(-updates|-security)? main$" | sort -u)
mirror=$(awk -v release="$release" '$3 == release {print $2; exit}' <<<"$sources")
[[ $mirror ]] || skip "apt knows no mirror of Debian $release"

root=$(mktemp -d "${TMPDIR:-/tmp}/bare-root.XXXXXX")
chmod 755 "$root"
clean_up() {
  cd /
  # A lazy unmount first: deleting must never cross into a folder of this machine.
  awk -v root="$root/" 'index($2, root) == 1 {print $2}' /proc/mounts | sort -r | xargs -r umount --lazy
  rm -rf --one-file-system "$root"
}
trap clean_up EXIT

# Folders are shown read only, files are copied: packages may want to replace a file.
bring() {
  mkdir -p "$root${1%/*}"
  if [[ -d $1 ]]; then
    mkdir -p "$root$1"
    mount --bind "$1" "$root$1"
    mount -o remount,bind,ro "$root$1"
  else
    cp "$1" "$root$1"
  fi
}

echo "bare-root: making Debian $release with git, make and sudo"
if ! debootstrap --variant=minbase --include=git,make,sudo,ca-certificates "$release" "$root" "$mirror" >"$root.log" 2>&1; then
  tail -20 "$root.log"
  rm -f "$root.log"
  exit 1
fi
rm -f "$root.log"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
echo "$sources" >"$root/etc/apt/sources.list"
apt-config dump | grep -E '^Acquire::(Check-|[a-z]+::Proxy)' >"$root/etc/apt/apt.conf.d/99bare-root" || true

# pip's settings with the local folders and files that they name; an index `simple` lies beside its files.
settings=$(python3 -m pip config list 2>/dev/null | sed -nE "s/^(global|:env:)\.([^=]+)='(.*)'$/\2 = \3/p" | sort -u -t= -k1,1)
printf '[global]\n%s\n' "$settings" >"$root/etc/pip.conf"
{ grep -oE '(file://| )/[^ :]+' <<<"$settings" || true; } | sed -E 's,^(file://| ),,; s,/simple/?$,,' | sort -u | while read -r path; do
  if [[ -e $path ]]; then bring "$path"; fi
done

chroot "$root" useradd --create-home --shell /bin/bash "$person"
echo "$person ALL=(ALL) NOPASSWD: ALL" >"$root/etc/sudoers.d/$person"
git clone -q --no-hardlinks "$top" "$root/home/$person/robot"
chroot "$root" chown -R "$person:" "/home/$person/robot"
echo "bare-root: make $* at $(git -C "$top" rev-parse --short HEAD)"
chroot "$root" su - "$person" -c "cd robot && LANG=C.UTF-8 make $*"
