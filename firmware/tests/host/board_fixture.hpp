/// @file
/// The whole firmware on the stub of the hardware, as its tests use it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>

#include "../../hal_host/hal_host.hpp"
#include "../../logic/board.hpp"
#include "definitions.hpp"
#include "frames.hpp"

using frames::Bytes;

// Offsets within FirmwareState and FirmwareHealth
constexpr int kHeightAt = 4, kLedAt = 25, kFaultAt = 26;
constexpr int kRefusedAt = 11, kLastRefusalAt = 21;

class BoardTest : public testing::Test {
 protected:
  void SetUp() override {
    hal_host::renew();
    board_.start();
  }

  void send(const Bytes& bytes) {
    hardware().to_firmware.insert(hardware().to_firmware.end(), bytes.begin(), bytes.end());
  }

  /// Lets time pass; with commands each 100 ms unless silent.
  void pass(int ms, bool is_silent = false) {
    for (int i = 0; i < ms; ++i) {
      if (!is_silent && i % 100 == 0) {
        send(frames::command(++seq_, height_m_));
      }
      hardware().pass_ms();
      board_.step();
    }
  }

  static hal_host::Hardware& hardware() { return hal_host::hardware(); }

  /// Newest payload of each topic that has been sent; clears what was sent.
  std::map<int, Bytes> sent() {
    std::map<int, Bytes> found;
    const Bytes& bytes = hardware().from_firmware;
    for (std::size_t at = 0; at + 8 <= bytes.size();) {
      EXPECT_EQ(bytes[at], 0xFF);
      EXPECT_EQ(bytes[at + 1], 0xFE);
      const std::size_t length = bytes[at + 2];
      const auto payload = bytes.begin() + static_cast<std::ptrdiff_t>(at) + 7;
      found[bytes[at + 5] | bytes[at + 6] << 8] = Bytes(payload, payload + static_cast<std::ptrdiff_t>(length));
      at += length + 8;
    }
    hardware().from_firmware.clear();
    return found;
  }

  int fault() { return sent()[mtr::kTopicState].at(kFaultAt); }
  int last_refusal() { return sent()[mtr::kTopicHealth].at(kLastRefusalAt); }

  float height_m_ = 0.0F;
  std::uint32_t seq_ = 0;
  mtr::PressMemory memory_ = {};
  mtr::StopMemory stop_memory_ = {};
  mtr::Board board_{&memory_, &stop_memory_};
};
