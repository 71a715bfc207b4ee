/// @file
/// What the whole firmware says on its line, and when.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "../../logic/link/endpoints.hpp"
#include "board_fixture.hpp"

namespace {

TEST_F(BoardTest, AnnouncesItsTopicsAndReports) {
  pass(300);
  const auto found = sent();
  EXPECT_TRUE(found.count(mtr::kTopicNegotiate));
  EXPECT_TRUE(found.count(mtr::kTopicSubscriber));
  EXPECT_TRUE(found.count(mtr::kTopicTime));
  EXPECT_EQ(found.at(mtr::kTopicState).size(), static_cast<std::size_t>(MTR_FIRMWARESTATE_BYTES));
  EXPECT_EQ(found.at(mtr::kTopicHealth).size(), static_cast<std::size_t>(MTR_FIRMWAREHEALTH_BYTES));
  EXPECT_EQ(found.at(mtr::kTopicEcho), Bytes{static_cast<std::uint8_t>(seq_)});
}

TEST_F(BoardTest, IsSilentAfterAStopUntilItIsAsked) {
  pass(300);
  send(frames::frame(mtr::kTopicStop, {}));
  pass(10, true);
  sent();
  pass(2000, true);
  EXPECT_TRUE(sent().empty());
  send(frames::frame(mtr::kTopicNegotiate, {}));
  pass(300);
  EXPECT_TRUE(sent().count(mtr::kTopicState));
}

TEST_F(BoardTest, TellsAllTopicsBeforeItReportsWhenItIsAsked) {
  for (int start_ms = 0; start_ms < 40; ++start_ms) {
    pass(301);
    sent();
    send(frames::frame(mtr::kTopicNegotiate, {}));
    // A pass for TIME and one for each topic but the last.
    pass(mtr::kEndpointCount, true);
    const auto found = sent();
    EXPECT_TRUE(found.count(mtr::kTopicSubscriber));
    EXPECT_FALSE(found.count(mtr::kTopicState)) << start_ms;
  }
}

TEST_F(BoardTest, AnnouncesAgainWhileNobodyAnswers) {
  pass(500);
  sent();
  pass(2000);
  EXPECT_TRUE(sent().count(mtr::kTopicSubscriber));
}

TEST_F(BoardTest, DoesNotAnnounceAgainWhileTheHostAnswersAndCommands) {
  pass(100);
  for (int i = 0; i < 10; ++i) {
    send(frames::frame(mtr::kTopicTime, Bytes(8, 0)));
    pass(300);
    if (i == 2) {
      sent();
    }
  }
  EXPECT_FALSE(sent().count(mtr::kTopicSubscriber));
}

TEST_F(BoardTest, DropsAndCountsReportsWhenTheLineIsFull) {
  pass(300);
  sent();
  hardware().room = 3;
  pass(300);
  EXPECT_TRUE(sent().empty());
  hardware().room = 255;
  pass(300);
  const Bytes health = sent()[mtr::kTopicHealth];
  EXPECT_GE(health.at(19) | health.at(20) << 8, 10);
}

}  // namespace
