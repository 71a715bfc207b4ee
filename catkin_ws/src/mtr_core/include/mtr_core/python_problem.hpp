/// @file
/// Problems in Python modules of C++ cores: the fields of mtr_msgs/Problem as plain tuples. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <vector>

#include "mtr_core/problem.hpp"

namespace mtr_core {

/// Code, text, names and values.
using ProblemTuple = std::tuple<std::string, std::string, std::vector<std::string>, std::vector<std::string>>;

namespace detail {

/// Message type for messages_of and problem_of.
struct PlainProblem {
  std::string code;
  std::string text;
  std::vector<std::string> names;
  std::vector<std::string> values;
};

}  // namespace detail

/// Returns the problem and its causes, outermost first.
inline std::vector<ProblemTuple> tuples_of(const Problem& problem) {
  std::vector<ProblemTuple> tuples;
  for (const auto& [code, text, names, values] : messages_of<detail::PlainProblem>(problem)) {
    tuples.emplace_back(code, text, names, values);
  }
  return tuples;
}

/// Returns the problem in these tuples, or one with only the text if there are none.
inline Problem problem_in(const std::vector<ProblemTuple>& tuples, const std::string& text) {
  std::vector<detail::PlainProblem> messages;
  for (const auto& [code, sentence, names, values] : tuples) {
    messages.push_back({code, sentence, names, values});
  }
  return problem_of(messages, text);
}

}  // namespace mtr_core
