/// @file
/// Runs the firmware of the peripherals on an emulated board.
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "options.hpp"
#include "session.hpp"

namespace {

volatile std::sig_atomic_t stop = 0;

void on_signal(int) { stop = 1; }

}  // namespace

int main(int count, char** words) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  try {
    emulator::Session session(emulator::options_of(count, words));
    std::puts("ready");
    std::fflush(stdout);
    session.run(&stop);
  } catch (const std::invalid_argument& wrong) {
    std::fprintf(stderr, "%s\n%s\n", wrong.what(), emulator::kUsage);
    return 2;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
  return 0;
}
