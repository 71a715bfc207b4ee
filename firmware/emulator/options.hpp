/// @file
/// Command line of the emulator.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "lift_plant.hpp"

namespace emulator {

struct Options {
  std::string elf, mcu, pty, control, eeprom;
  bool is_stepped = false;
  std::uint32_t quantum_us = 500;
  std::uint32_t seed = 1;
  LiftParameters lift;
};

/// Reads the command line. Throws std::invalid_argument with a sentence.
Options options_of(int count, char** words);

extern const char kUsage[];

}  // namespace emulator
