/// @file
/// Frames found in good and damaged streams.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "../../logic/link/endpoints.hpp"
#include "../../logic/link/frame_reader.hpp"
#include "../../logic/link/messages.hpp"
#include "frames.hpp"

namespace {

using frames::Bytes;

class FrameReaderTest : public testing::Test {
 protected:
  void push(const Bytes& bytes) {
    for (std::uint8_t byte : bytes) {
      reader_.push(byte);
    }
  }

  static void take(void* self, std::uint16_t topic, const std::uint8_t*, std::uint8_t) {
    static_cast<FrameReaderTest*>(self)->topics_.push_back(topic);
  }

  std::vector<int> topics_;
  mtr::Counters counters_;
  mtr::FrameReader reader_{mtr::host_payload_bytes, take, this, &counters_};
};

TEST_F(FrameReaderTest, FindsFramesOneAfterTheOther) {
  push(frames::command(1, 0.5F));
  push(frames::frame(mtr::kTopicNegotiate, {}));
  push(frames::press(1, 1, 1.0F, 100));
  EXPECT_EQ(topics_, (std::vector<int>{100, 0, 101}));
  EXPECT_FALSE(reader_.is_waiting());
}

TEST_F(FrameReaderTest, CountsAWrongChecksumAndGoesOn) {
  Bytes damaged = frames::command(1, 0.5F);
  damaged.back() = static_cast<std::uint8_t>(damaged.back() ^ 1);
  push(damaged);
  push(frames::command(2, 0.5F));
  EXPECT_EQ(topics_, (std::vector<int>{100}));
  EXPECT_EQ(counters_.checksum_errors, 1);
}

TEST_F(FrameReaderTest, FindsTheFrameThatACutOffOneSeemsToSwallow) {
  Bytes cut = frames::press(1, 1, 1.0F, 100);
  cut.resize(9);
  push(cut);
  push(frames::command(2, 0.5F));
  EXPECT_EQ(topics_, (std::vector<int>{100}));
}

TEST_F(FrameReaderTest, SkipsAndCountsUnknownTopicsAndOtherLengths) {
  push(frames::frame(999, {1, 2, 3}));
  push(frames::frame(100, {1, 2, 3}));
  EXPECT_TRUE(topics_.empty());
  EXPECT_EQ(counters_.skipped_frames, 2);
}

TEST_F(FrameReaderTest, SkipsAnOversizedFrameAndFindsTheNext) {
  push(frames::frame(100, Bytes(5000, 0x55)));
  push(frames::command(2, 0.5F));
  EXPECT_EQ(topics_, (std::vector<int>{100}));
  EXPECT_EQ(counters_.skipped_frames, 1);
}

TEST_F(FrameReaderTest, SkipsRevisionOne) {
  Bytes old = frames::command(1, 0.5F);
  old[1] = 0xFF;
  push(old);
  EXPECT_TRUE(topics_.empty());
}

TEST_F(FrameReaderTest, GivesUpAFrameThatDoesNotGoOn) {
  Bytes cut = frames::command(1, 0.5F);
  cut.pop_back();
  push(cut);
  EXPECT_TRUE(reader_.is_waiting());
  reader_.flush();
  EXPECT_FALSE(reader_.is_waiting());
  EXPECT_EQ(counters_.skipped_frames, 1);
}

TEST(Messages, RefuseAWrongCrc) {
  Bytes bytes = frames::press(7, 2, 0.5F, 300);
  mtr::Press press{};
  const std::uint8_t length = static_cast<std::uint8_t>(bytes.size() - mtr::kFrameOverheadBytes);
  EXPECT_TRUE(mtr::read(bytes.data() + mtr::kHeaderBytes, length, &press));
  EXPECT_EQ(press.id, 7U);
  EXPECT_EQ(press.servos, 2);
  EXPECT_EQ(press.strength, 0.5F);
  EXPECT_EQ(press.hold_ms, 300);
  bytes[mtr::kHeaderBytes] = 8;
  EXPECT_FALSE(mtr::read(bytes.data() + mtr::kHeaderBytes, length, &press));
}

TEST(Messages, RefuseAShortPayload) {
  const std::uint8_t payload[] = {1};
  mtr::Command command{};
  EXPECT_FALSE(mtr::read(payload, 0, &command));
  EXPECT_FALSE(mtr::read(payload, 1, &command));
}

}  // namespace
