/// @file
/// Table of patterns.
// SPDX-License-Identifier: Apache-2.0
#include "leds.hpp"

#include "progmem.hpp"

namespace mtr {
namespace {

constexpr uint8_t kLedCount = 3;

/// Slots of 2 s as bits, for green, yellow and red; red only for what needs a person.
const uint16_t kPatterns[kLedPatternCount][kLedCount] PROGMEM = {
    {0x0000, 0x0000, 0x0000},  // off
    {0x0000, 0x0F0F, 0x0000},  // starting: yellow, slow
    {0xFFFF, 0x0000, 0x0000},  // ready: green
    {0x3333, 0x0000, 0x0000},  // mapping: green, fast
    {0x0000, 0x3333, 0x0000},  // moving: yellow, fast
    {0xFFFF, 0xFFFF, 0x0000},  // pressing: green and yellow
    {0x0101, 0x0101, 0x0000},  // paused: green and yellow, a flash per second
    {0x0000, 0x0000, 0xFFFF},  // error: red
    {0x0000, 0x0000, 0x3333},  // link lost: red, fast
    {0x0000, 0x0505, 0x0000},  // warning: yellow, two flashes per second
    {0xAAAA, 0x5555, 0x0000},  // about to set off: green and yellow in turn, very fast
};

}  // namespace

uint8_t leds_of(uint8_t pattern, uint8_t slot) {
  uint8_t lit = 0;
  for (uint8_t led = 0; led < kLedCount; ++led) {
    if (pgm_read_word(&kPatterns[pattern][led]) >> slot & 1) {
      lit = static_cast<uint8_t>(lit | 1 << led);
    }
  }
  return lit;
}

}  // namespace mtr
