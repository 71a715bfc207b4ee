/// @file
/// Command line of the offline replay.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "replay/options.hpp"
#include "sentence.hpp"

namespace mtr_localization::replay {
namespace {

TEST(ReplayOptions, EverythingIsUnderstood) {
  const Options options = parse({"a.bag", "--out", "there", "--front-only", "--parameter", "surface_sigma_m=0.006",
                                 "--parameter", "rear_lidar_x_m=-0.3", "--loop-end", "12.5"});
  EXPECT_EQ(options.bag, "a.bag");
  EXPECT_EQ(options.folder, "there");
  EXPECT_TRUE(options.front_only);
  EXPECT_TRUE(options.parameters.lockstep);
  EXPECT_EQ(options.parameters.adjustment.surface_sigma_m, 0.006);
  EXPECT_EQ(options.mounting.rear_lidar_x_m, -0.3);
  EXPECT_EQ(options.loop_end_ns, 12'500'000'000);
}

TEST(ReplayOptions, WhatIsNotUnderstoodIsASentence) {
  expect_sentence([] { parse({}); }, "Usage");
  expect_sentence([] { parse({"a.bag", "--out"}); }, "--out needs a value");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--fast"}); }, "'--fast' is not understood");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "colour=1"}); }, "colour is unknown");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "surface_sigma_m=7"}); }, "allowed is");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--parameter", "surface_sigma_m=x"}); }, "no number");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--loop-end", "nan"}); }, "no number");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--loop-end", "9", "--map", "m"}); }, "give one of them");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--begin-at", "1", "2", "3"}); }, "give --map");
  expect_sentence([] { parse({"a.bag", "--out", "b", "--map", "m", "--begin-at", "1", "2"}); }, "needs a value");
}

TEST(ReplayOptions, HelpTellsEachParameterOnceWithItsDefaultAndRange) {
  EXPECT_TRUE(asks_for_help({"a.bag", "--help"}));
  EXPECT_TRUE(asks_for_help({"-h"}));
  EXPECT_FALSE(asks_for_help({"a.bag", "--out", "there"}));
  const std::string text = help();
  EXPECT_NE(text.find("  range_noise_m=0.015  0.001 to 0.1 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  rear_lidar_x_m=-0.2  -2 to 2 m\n"), std::string::npos) << text;
  const Options options;
  for_each_group(options.parameters, [&](const auto& rows, const auto&) {
    for (const auto& row : rows) {
      const std::string line = std::string("\n  ") + row.name + "=";
      EXPECT_EQ(text.find(line), text.rfind(line)) << row.name;
      EXPECT_NE(text.find(line), std::string::npos) << row.name;
    }
  });
}

}  // namespace
}  // namespace mtr_localization::replay
