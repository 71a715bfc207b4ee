/// @file
/// Orders to the fault injection node.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/fault_order.hpp"

namespace mtr_rviz {
namespace {

const FaultCatalogue kCatalogue{{"imu", {"off", "stuck"}}, {"cpu", {"slow"}}};

TEST(FaultOrder, WhatTheCatalogueHasIsOrdered) {
  const auto order = order_of(kCatalogue, {"imu", "stuck", 2.0, 0.0});
  ASSERT_TRUE(order);
  EXPECT_EQ(order->kind, "stuck");
  EXPECT_TRUE(order_of(kCatalogue, {"imu", kNoFault, 1.0, 0.0}));
}

TEST(FaultOrder, WhatTheCatalogueHasNotIsNoOrder) {
  EXPECT_FALSE(order_of(kCatalogue, {"imu", "slow", 2.0, 0.0}));
  EXPECT_FALSE(order_of(kCatalogue, {"lift", "stuck", 2.0, 0.0}));
  EXPECT_FALSE(order_of({}, {"imu", kNoFault, 2.0, 0.0}));
}

TEST(FaultOrder, NumbersThatCannotBeAreNoOrder) {
  EXPECT_FALSE(order_of(kCatalogue, {"imu", "off", 0.0, 0.0}));
  EXPECT_FALSE(order_of(kCatalogue, {"imu", "off", NAN, 0.0}));
  EXPECT_FALSE(order_of(kCatalogue, {"imu", "off", 1.0, -1.0}));
}

TEST(FaultOrder, SentenceCountsDownToZero) {
  EXPECT_EQ(fault_sentence("imu", "off", 1.2), "imu: off, for another 2 s.");
  EXPECT_EQ(fault_sentence("imu", "off", -5.0), "imu: off, for another 0 s.");
}

}  // namespace
}  // namespace mtr_rviz
