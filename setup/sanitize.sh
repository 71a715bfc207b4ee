#!/usr/bin/env bash
# The C++ tests in builds with sanitizers, each kind in a workspace of its own below out/sanitize: nothing that was built
# without them may be linked in, for Eigen allocates otherwise with them.
# Usage: sanitize.sh [address|thread ...], PACKAGES="..." for some of them
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD
# GCC finds members of an empty optional uninitialized in a build with sanitizers, and in no other.
common="-O1 -g -fno-omit-frame-pointer -Wno-error=maybe-uninitialized"
declare -A flags=([address]="-fsanitize=address,undefined -fno-sanitize-recover=all" [thread]="-fsanitize=thread")
read -r -a packages <<<"${PACKAGES:-mtr_core mtr_surfel_map mtr_drive_control mtr_localization}"
# An exit of its own, so that a finding is no failed assertion. No suppressions: what is found is mended.
export ASAN_OPTIONS=exitcode=66:detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=exitcode=66:halt_on_error=1
# OpenMP's library is not built with a sanitizer, which so does not see its barriers; who uses it is CHOLMOD, below the
# Ceres of a test's oracle. No code of this project does.
export OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1
unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH
export PATH="/usr/bin:$PATH"

failed=0
for kind in "${@:-address}"; do
  [[ -n "${flags[$kind]:-}" ]] || { echo "There is no sanitizer $kind; there are: ${!flags[*]}." >&2; exit 2; }
  space=$top/out/sanitize/$kind
  mkdir -p "$space"
  echo "Building with sanitizer $kind"
  catkin config --workspace "$space" --init --source-space "$top" --cmake-args "-DPYTHON_EXECUTABLE=$top/.venv/bin/python" \
    -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=$common ${flags[$kind]}" -Wno-dev >/dev/null
  catkin build --workspace "$space" --no-status --no-notify -j2 "${packages[@]}" >"$space/build.log" 2>&1 || {
    cat "$space/build.log"
    exit 1
  }
  for package in "${packages[@]}"; do
    make -s -j2 -C "$space/build/$package" tests >"$space/$package.log" 2>&1 || { cat "$space/$package.log"; exit 1; }
    for test in "$space/devel/.private/$package/lib/$package"/*_test; do
      "$test" --gtest_brief=1 || { echo "$kind: ${test##*/} ended with status $?"; failed=1; }
    done
  done
done
exit $failed
