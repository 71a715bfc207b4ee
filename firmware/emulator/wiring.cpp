/// @file
/// Table of boards; addresses from the data sheets' register summaries.
// SPDX-License-Identifier: Apache-2.0
#include "wiring.hpp"

#include <stdexcept>

namespace emulator {
namespace {

constexpr std::uint16_t kPortA = 0x22, kPortC = 0x28, kPortD = 0x2B, kPortG = 0x34, kPortH = 0x102;

const Wiring kWirings[] = {
    {"atmega2560",
     {kPortH, 6},
     {kPortG, 5},
     {{kPortA, 0}, {kPortA, 1}, {kPortA, 2}},
     {kPortA, 4},
     {kPortA, 5},
     'A',
     3,
     0x1FF},
    {"atmega328p",
     {kPortD, 3},
     {kPortD, 4},
     {{kPortD, 5}, {kPortD, 6}, {kPortD, 7}},
     {kPortC, 2},
     {kPortC, 3},
     'C',
     1,
     0xFF},
};

}  // namespace

const Wiring& wiring_of(const std::string& mcu) {
  for (const Wiring& wiring : kWirings) {
    if (mcu == wiring.mcu) {
      return wiring;
    }
  }
  throw std::invalid_argument("There is no wiring for the microcontroller " + mcu +
                              "; atmega2560 and atmega328p have one.");
}

}  // namespace emulator
