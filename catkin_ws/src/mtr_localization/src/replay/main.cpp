/// @file
/// Entry point of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "replay/options.hpp"
#include "replay/replay.hpp"
#include "replay/result_files.hpp"

namespace {

void show(int percent) { std::fprintf(stderr, "\rlocalizing %3d %%%s", percent, percent < 100 ? "" : "\n"); }

}  // namespace

int main(int argc, char** argv) {
  using namespace mtr_localization::replay;
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (asks_for_help(arguments)) {
      std::fputs(help().c_str(), stdout);
      return 0;
    }
    const Options options = parse(arguments);
    // Progress is shown on a terminal only.
    const Progress progress = isatty(STDERR_FILENO) != 0 ? Progress(show) : Progress();
    write_files(Replay(options).run(progress), options.bag, options.folder);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
