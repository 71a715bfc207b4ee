# To be sourced: a Debian in a folder of its own, made by debootstrap; bare_root.sh and noetic_root.sh work in one.
# Mounts and processes live in namespaces that end with the script. What is not committed is not in the clone. apt's mirror and
# pip's settings are those of this machine, read at run time. Who sources it sets `proof`, the name that messages begin with.
# SPDX-License-Identifier: Apache-2.0
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
person=developer

skip() {
  echo "$proof: skipped, $1"
  exit 0
}

# Runs the script (its path and arguments) again in namespaces of its own, unless this is that run.
isolate() {
  [[ ${FRESH_ROOT_ISOLATED:-} != yes ]] || return 0
  ((EUID == 0)) || skip "it needs root"
  for program in debootstrap unshare chroot; do
    command -v "$program" >/dev/null || skip "$program is missing"
  done
  unshare --mount --pid --fork true 2>/dev/null || skip "this machine grants no namespaces"
  exec env FRESH_ROOT_ISOLATED=yes unshare --mount --pid --fork --kill-child "$@"
}

# apt's lines of this machine for its main archive of the release; if it knows none, its mirror's for that release.
apt_sources() {
  local release=$1 known mirror
  known=$(apt-get indextargets --format 'deb $(REPO_URI) $(CODENAME) main' 'Created-By: Packages' 'Component: main' \
    'Origin: Debian' | sort -u)
  if ! grep -E " $release(-updates|-security)? main$" <<<"$known"; then
    mirror=$(awk '$3 !~ /-/ {print $2; exit}' <<<"$known")
    [[ -z $mirror ]] || echo "deb $mirror $release main"
  fi
}

# Makes a Debian of the release, sets `root` to its folder and mounts what it needs. A second argument is a folder that is kept, and
# taken up again if a Debian is in it already; else the folder is a temporary one and is removed with the script's end.
make_root() {
  local release=$1 sources mirror log
  sources=$(apt_sources "$release")
  mirror=$(awk -v release="$release" '$3 == release {print $2; exit}' <<<"$sources")
  [[ $mirror ]] || skip "apt knows no mirror of Debian $release"
  kept=${2:-}
  if [[ $kept ]]; then
    root=$(mkdir -p "$kept" && cd "$kept" && pwd)
  else
    root=$(mktemp -d "${TMPDIR:-/tmp}/$proof.XXXXXX")
  fi
  chmod 755 "$root"
  trap clean_up EXIT
  if [[ ! -e $root/etc/debian_version ]]; then
    echo "$proof: making Debian $release with git, make and sudo"
    log=$root.log
    if ! debootstrap --variant=minbase --include=git,make,sudo,ca-certificates "$release" "$root" "$mirror" >"$log" 2>&1; then
      tail -20 "$log"
      rm -f "$log"
      exit 1
    fi
    rm -f "$log"
  fi
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount --make-rslave "$root/dev"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  echo "$sources" >"$root/etc/apt/sources.list"
  apt-config dump | grep -E '^Acquire::(Check-|[a-z]+::Proxy)' >"$root/etc/apt/apt.conf.d/99fresh-root" || true
  bring_pip_settings
}

clean_up() {
  cd /
  # A lazy unmount first: deleting must never cross into a folder of this machine.
  awk -v root="$root/" 'index($2, root) == 1 {print $2}' /proc/mounts | sort -r | xargs -r umount --lazy
  [[ $kept ]] || rm -rf --one-file-system "$root"
}

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

# pip's settings with the local folders and files that they name; an index `simple` lies beside its files.
bring_pip_settings() {
  local settings
  settings=$(python3 -m pip config list 2>/dev/null | sed -nE "s/^(global|:env:)\.([^=]+)='(.*)'$/\2 = \3/p" | sort -u -t= -k1,1)
  printf '[global]\n%s\n' "$settings" >"$root/etc/pip.conf"
  { grep -oE '(file://| )/[^ :]+' <<<"$settings" || true; } | sed -E 's,^(file://| ),,; s,/simple/?$,,' | sort -u | while read -r path; do
    if [[ -e $path ]]; then bring "$path"; fi
  done
}

# Clones this checkout's commit into a folder of the person's, who is made; a clone in a root that was kept is brought to it.
clone_for_person() {
  local folder=$root/home/$person/$1
  chroot "$root" id "$person" >/dev/null 2>&1 || chroot "$root" useradd --create-home --shell /bin/bash "$person"
  echo "$person ALL=(ALL) NOPASSWD: ALL" >"$root/etc/sudoers.d/$person"
  if [[ -e $folder ]]; then
    git -c safe.directory='*' -C "$folder" fetch -q "$top" HEAD
    git -c safe.directory='*' -C "$folder" reset -q --hard FETCH_HEAD
  else
    mkdir -p "$(dirname "$folder")"
    git clone -q --no-hardlinks "$top" "$folder"
  fi
  chroot "$root" chown -R "$person:" "/home/$person"
}

# A command line in the person's home.
as_person() {
  chroot "$root" su - "$person" -c "export LANG=C.UTF-8; $*"
}
