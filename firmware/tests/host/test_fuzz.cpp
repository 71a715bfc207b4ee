/// @file
/// A million damaged frames: nothing is written out of bounds, and good frames are found again.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "../../hal_host/hal_host.hpp"
#include "../../logic/board.hpp"
#include "../../logic/link/endpoints.hpp"
#include "frames.hpp"

namespace {

using frames::Bytes;

constexpr int kFrames = 1000000;
constexpr int kFramesThroughTheBoard = 50000;
constexpr std::uint32_t kSeed = 20240517;

class Mutator {
 public:
  Bytes next() {
    Bytes bytes = original();
    for (std::uint32_t i = random() % 4 + 1; i > 0; --i) {
      mutate(&bytes);
    }
    return bytes;
  }

  std::uint32_t random() { return static_cast<std::uint32_t>(random_()); }

 private:
  Bytes original() {
    switch (random() % 7) {
      case 0:
        return frames::command(random(), static_cast<float>(random() % 2000) * 1e-3F);
      case 1:
        return frames::press(random(), static_cast<std::uint8_t>(random()), 0.5F, 200);
      case 2:
        return frames::calibrate(random(), 1.2F);
      case 5:
        return frames::signals(static_cast<std::uint8_t>(random() % 4), 1, 1);
      case 3:
        return frames::frame(mtr::kTopicTime, Bytes(8, static_cast<std::uint8_t>(random())));
      case 4:
        return frames::frame(static_cast<std::uint16_t>(random() % 130), Bytes(random() % 40, 0xFF));
      default:
        return frames::frame(mtr::kTopicNegotiate, {});
    }
  }

  void mutate(Bytes* bytes) {
    const std::size_t at = bytes->empty() ? 0 : random() % bytes->size();
    switch (bytes->empty() ? 0 : random() % 5) {
      case 0:
        bytes->insert(bytes->begin() + static_cast<std::ptrdiff_t>(at), static_cast<std::uint8_t>(random()));
        break;
      case 1:
        bytes->erase(bytes->begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 2:
        (*bytes)[at] = static_cast<std::uint8_t>(random());
        break;
      case 3:
        (*bytes)[at] = random() % 2 ? 0xFF : 0xFE;
        break;
      default:
        bytes->resize(at);
        break;
    }
  }

  std::mt19937 random_{kSeed};
};

struct Seen {
  std::uint32_t seq = 0;
};

void take(void* seen, std::uint16_t topic, const std::uint8_t* payload, std::uint8_t length) {
  mtr::Command command;
  if (topic == mtr::kTopicCommand && mtr::read(payload, length, &command)) {
    static_cast<Seen*>(seen)->seq = command.seq;
  }
}

TEST(Fuzz, ReaderFindsTheSecondGoodFrameAfterAnyDamage) {
  Mutator mutator;
  Seen seen;
  mtr::Counters counters;
  mtr::FrameReader reader(mtr::host_payload_bytes, take, &seen, &counters);
  for (std::uint32_t i = 1; i <= kFrames; ++i) {
    Bytes bytes = mutator.next();
    for (int copy = 0; copy < 2; ++copy) {
      const Bytes good = frames::command(i, 0.5F);
      bytes.insert(bytes.end(), good.begin(), good.end());
    }
    seen.seq = 0;
    for (std::uint8_t byte : bytes) {
      reader.push(byte);
    }
    ASSERT_EQ(seen.seq, i);
  }
}

TEST(Fuzz, BoardStaysWithinItsLimits) {
  hal_host::renew();
  hal_host::Hardware& hardware = hal_host::hardware();
  mtr::PressMemory memory = {};
  mtr::StopMemory stop_memory = {};
  mtr::Board board(&memory, &stop_memory);
  board.start();
  Mutator mutator;
  for (int i = 0; i < kFramesThroughTheBoard; ++i) {
    const Bytes bytes = mutator.next();
    hardware.to_firmware.insert(hardware.to_firmware.end(), bytes.begin(), bytes.end());
    hardware.position = static_cast<std::uint16_t>(mutator.random() % 1024);
    hardware.pass_ms();
    board.step();
    hardware.from_firmware.clear();
    ASSERT_LE(std::abs(hardware.duty), mtr::kFullDuty);
    for (std::uint16_t width : hardware.servo_us) {
      ASSERT_GE(width, 1000);
      ASSERT_LE(width, 2000);
    }
  }
}

}  // namespace
