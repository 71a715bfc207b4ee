#!/usr/bin/env bash
# Installs the Debian packages and the virtual environment that are missing; quick when nothing is.
# Usage: install.sh [FILE with further Debian packages]
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t wanted < <(grep -hvE '^\s*(#|$)' setup/debian-packages.txt ${1:+"$1"})
installed=$(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' 2>/dev/null | awk '$1 == "ii" {print $2}')
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "$package" <<<"$installed" || missing+=("$package")
done

if ((${#missing[@]})); then
  as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "Debian packages are missing and neither root nor sudo is here: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

mkdir -p .setup
fingerprint=$(cat setup/python-requirements.txt <(/usr/bin/python3 --version) <(pwd) | sha256sum)
if [[ ! -x .venv/bin/python || "$(cat .setup/venv 2>/dev/null)" != "$fingerprint" ]]; then
  echo "Making the virtual environment .venv"
  rm -rf .venv
  /usr/bin/python3 -m venv --system-site-packages .venv
  .venv/bin/pip install -qq --disable-pip-version-check --no-input -r setup/python-requirements.txt
  echo "$fingerprint" >.setup/venv
fi
