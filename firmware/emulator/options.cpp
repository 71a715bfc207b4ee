/// @file
/// Options by name, each with a value but --stepped.
// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <functional>
#include <map>
#include <stdexcept>

namespace emulator {
namespace {

double number_of(const std::string& name, const std::string& text, double low, double high) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(value >= low && value <= high)) {
    throw std::invalid_argument(name + " was " + text + "; allowed is " + std::to_string(low) + " to " +
                                std::to_string(high) + ".");
  }
  return value;
}

}  // namespace

const char kUsage[] =
    "mtr_emulator --elf FILE --mcu atmega2560|atmega328p --pty LINK --control SOCKET\n"
    "  [--stepped] [--quantum-us N] [--eeprom FILE] [--seed N] [--stroke-m M] [--low-mv MV] [--high-mv MV]";

Options options_of(int count, char** words) {
  Options options;
  const std::map<std::string, std::function<void(const std::string&, const std::string&)>> readers = {
      {"--elf", [&](auto&, auto& text) { options.elf = text; }},
      {"--mcu", [&](auto&, auto& text) { options.mcu = text; }},
      {"--pty", [&](auto&, auto& text) { options.pty = text; }},
      {"--control", [&](auto&, auto& text) { options.control = text; }},
      {"--eeprom", [&](auto&, auto& text) { options.eeprom = text; }},
      {"--quantum-us", [&](auto& name, auto& text) { options.quantum_us = number_of(name, text, 50, 20000); }},
      {"--seed", [&](auto& name, auto& text) { options.seed = number_of(name, text, 0, 4294967295.0); }},
      {"--stroke-m", [&](auto& name, auto& text) { options.lift.stroke_m = number_of(name, text, 0.05, 2.0); }},
      {"--low-mv", [&](auto& name, auto& text) { options.lift.low_mv = number_of(name, text, 0, 5000); }},
      {"--high-mv", [&](auto& name, auto& text) { options.lift.high_mv = number_of(name, text, 0, 5000); }},
  };
  for (int i = 1; i < count; ++i) {
    const std::string name = words[i];
    if (name == "--stepped") {
      options.is_stepped = true;
      continue;
    }
    const auto reader = readers.find(name);
    if (reader == readers.end() || i + 1 == count) {
      throw std::invalid_argument(reader == readers.end() ? "There is no option " + name + "."
                                                          : name + " lacks a value.");
    }
    reader->second(name, words[++i]);
  }
  if (options.elf.empty() || options.mcu.empty() || options.pty.empty() || options.control.empty()) {
    throw std::invalid_argument("--elf, --mcu, --pty and --control are needed.");
  }
  return options;
}

}  // namespace emulator
