/// @file
/// Orders to the fault injection node, and sentences about active faults.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mtr_rviz {

/// Catalogue of the node: kinds of faults by part.
using FaultCatalogue = std::map<std::string, std::vector<std::string>>;

/// One order; amount 0 selects the default.
struct FaultOrder {
  std::string part;
  std::string kind;
  double duration_s;
  double amount;
};

/// Kind that ends a part's fault.
inline constexpr char kNoFault[] = "none";

/// Returns the order if the catalogue contains it and its numbers are valid, otherwise nothing.
std::optional<FaultOrder> order_of(const FaultCatalogue& catalogue, const FaultOrder& wanted);

/// Returns the sentence about an active fault with its remaining time.
std::string fault_sentence(const std::string& part, const std::string& kind, double left_s);

}  // namespace mtr_rviz
