/// @file
/// Sentences with code and arguments, and their round trip through messages.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_core/problem.hpp"

namespace mtr_core {
namespace {

constexpr Sentence kTooClose{"planner.too_close", "{left_m:.2f} m are left {side}; at least {low_m} m, {count} times."};
constexpr Sentence kSilent{"planner.silent", "Localization is silent."};
constexpr Sentence kLost{"planner.lost", "The position is lost. {cause} Map the Car again."};

struct Message {
  std::string code;
  std::vector<std::string> names;
  std::vector<std::string> values;
  std::string text;
};

TEST(Problem, IsFormattedOnceAndKeepsItsValues) {
  const Problem problem = kTooClose({{"left_m", 0.123}, {"side", "ahead"}, {"low_m", 0.3}, {"count", std::int64_t{2}}});
  EXPECT_EQ(problem.text, "0.12 m are left ahead; at least 0.3 m, 2 times.");
  EXPECT_EQ(problem.code, "planner.too_close");
  ASSERT_EQ(problem.arguments.size(), 4U);
  EXPECT_EQ(problem.arguments[0], (std::pair<std::string, std::string>("left_m", "0.12")));
  EXPECT_EQ(problem.arguments[3].second, "2");
}

TEST(Problem, HasItsCauseInTheSentenceAndNotAmongTheArguments) {
  const Problem problem = kLost({{"cause", kSilent()}});
  EXPECT_EQ(problem.text, "The position is lost. Localization is silent. Map the Car again.");
  EXPECT_TRUE(problem.arguments.empty());
  ASSERT_NE(problem.cause, nullptr);
  EXPECT_EQ(problem.cause->code, "planner.silent");
}

TEST(Problem, IsFalseWhenThereIsNone) {
  EXPECT_FALSE(Problem{});
  EXPECT_TRUE(kSilent());
  EXPECT_TRUE(messages_of<Message>(Problem{}).empty());
}

TEST(Problem, IsOfTheSameKindWhileOnlyItsNumbersChange) {
  const auto close = [](double left_m, const char* side) {
    return kLost({{"cause", kTooClose({{"left_m", left_m}, {"side", side}, {"low_m", 0.3}, {"count", 1.0}})}}).kind();
  };
  EXPECT_EQ(close(0.12, "ahead"), close(0.34, "ahead"));
  EXPECT_NE(close(0.12, "ahead"), close(0.12, "behind"));
  EXPECT_NE(close(0.12, "ahead"), kLost({{"cause", kSilent()}}).kind());
  EXPECT_NE(problem_with_text("One.").kind(), problem_with_text("Two.").kind());
  EXPECT_EQ(Problem{}.kind(), "");
}

TEST(Problem, NeedsAValueForEachPlaceholder) { EXPECT_THROW(kTooClose({{"left_m", 0.1}}), std::invalid_argument); }

TEST(Problem, SurvivesItsWayThroughMessages) {
  const Problem sent =
      kLost({{"cause", kTooClose({{"left_m", 0.1}, {"side", "behind"}, {"low_m", 1.0}, {"count", 1.5}})}});
  const Problem received = problem_of(messages_of<Message>(sent), sent.text);
  EXPECT_EQ(received.code, sent.code);
  EXPECT_EQ(received.text, sent.text);
  ASSERT_NE(received.cause, nullptr);
  EXPECT_EQ(received.cause->code, sent.cause->code);
  EXPECT_EQ(received.cause->arguments, sent.cause->arguments);
}

TEST(Problem, IsATextAloneFromASenderWithoutCodes) {
  const Problem received = problem_of(std::vector<Message>{}, "Something.");
  EXPECT_EQ(received.text, "Something.");
  EXPECT_TRUE(received.code.empty());
}

}  // namespace
}  // namespace mtr_core
