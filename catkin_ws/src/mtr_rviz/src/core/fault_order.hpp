/// @file
/// What is asked of the node that injects faults, and the sentences on what it does.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mtr_rviz {

/// The node's catalogue: kinds of fault by part.
using FaultCatalogue = std::map<std::string, std::vector<std::string>>;

/// One order; amount 0 is the usual one.
struct FaultOrder {
  std::string part;
  std::string kind;
  double duration_s;
  double amount;
};

/// What ends a part's fault.
inline constexpr char kNoFault[] = "none";

/// The order, if the catalogue has it and its numbers can be; else nothing.
std::optional<FaultOrder> order_of(const FaultCatalogue& catalogue, const FaultOrder& wanted);

/// Of a fault that is injected now, for so long.
std::string fault_sentence(const std::string& part, const std::string& kind, double left_s);

}  // namespace mtr_rviz
