/// @file
/// Start of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "replay/options.hpp"
#include "replay/replay.hpp"
#include "replay/result_files.hpp"

int main(int argc, char** argv) {
  using namespace mtr_localization::replay;
  try {
    const Options options = parse({argv + 1, argv + argc});
    write_files(Replay(options).run(), options.bag, options.folder);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
