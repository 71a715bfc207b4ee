#!/usr/bin/env bash
# Runs make targets in a Debian 12 that holds nothing but git, make and sudo, on a fresh clone of this checkout's commit.
# Usage: bare_root.sh [TARGET...]   (default: test); it says that it was skipped where no such root can be made.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
proof=bare-root
source "$(dirname "${BASH_SOURCE[0]}")/fresh_root.bash"

isolate "$top/setup/bare_root.sh" "$@"
(($#)) || set -- test
make_root bookworm
clone_for_person robot
echo "$proof: make $* at $(git -C "$top" rev-parse --short HEAD)"
as_person "cd robot && make $*"
