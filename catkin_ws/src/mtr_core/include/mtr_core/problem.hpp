/// @file
/// Sentences for the Operator: code, arguments, and the resulting English sentence.
///
/// Each package declares its sentences in one table, its header `problems.hpp` (in Python its module `problems`).
/// Translations refer to the code, never to the text.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mtr_core {

/// One sentence for the Operator about a problem, or about what a node does or waits for. False if it is empty.
struct Problem {
  /// Stable identifier "package.what"; empty for a text without a code.
  std::string code;
  /// The sentence in English.
  std::string text;
  /// Name and formatted value of each placeholder.
  std::vector<std::pair<std::string, std::string>> arguments;
  /// The problem whose text replaces {cause}.
  std::shared_ptr<const Problem> cause;

  explicit operator bool() const { return !text.empty(); }

  /// Key that does not change with the numbers in the sentence: a log shows each kind once.
  std::string kind() const;
};

namespace detail {

inline bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0';
}

}  // namespace detail

inline std::string Problem::kind() const {
  std::string words;
  for (const Problem* each = this; each != nullptr && *each; each = each->cause.get()) {
    words += (each->code.empty() ? each->text : each->code) + '\n';
    for (const auto& [name, value] : each->arguments) {
      words += detail::is_number(value) ? "" : value + '\n';
    }
  }
  return words;
}

/// Returns a problem with only a text.
inline Problem problem_with_text(const std::string& text) { return {"", text, {}, nullptr}; }

/// Value of a placeholder.
struct Argument {
  std::string name;
  std::variant<std::string, double, std::int64_t, Problem> value;
};

/// A row of a package's table: a call with the values of its placeholders returns the problem.
struct Sentence {
  const char* code;
  /// English sentence with named placeholders; {name:.1f} has the format of printf's %.1f.
  const char* text;

  /// @throws std::invalid_argument if the value of a placeholder is missing
  Problem operator()(std::initializer_list<Argument> arguments = {}) const;
};

namespace detail {

inline std::string formatted(const Argument& argument, const std::string& spec) {
  if (const auto* number = std::get_if<double>(&argument.value)) {
    char text[64];
    std::snprintf(text, sizeof(text), ("%" + (spec.empty() ? "g" : spec)).c_str(), *number);
    return text;
  }
  if (const auto* whole = std::get_if<std::int64_t>(&argument.value)) {
    return std::to_string(*whole);
  }
  const auto* problem = std::get_if<Problem>(&argument.value);
  return problem != nullptr ? problem->text : std::get<std::string>(argument.value);
}

inline const Argument& argument_of(const std::string& name, std::initializer_list<Argument> arguments) {
  for (const Argument& argument : arguments) {
    if (argument.name == name) {
      return argument;
    }
  }
  throw std::invalid_argument("Placeholder " + name + " has no value.");
}

inline void add(const Argument& argument, const std::string& spec, Problem& problem) {
  const std::string value = formatted(argument, spec);
  problem.text += value;
  if (const auto* cause = std::get_if<Problem>(&argument.value)) {
    problem.cause = std::make_shared<const Problem>(*cause);
  } else {
    problem.arguments.emplace_back(argument.name, value);
  }
}

}  // namespace detail

inline Problem Sentence::operator()(std::initializer_list<Argument> arguments) const {
  Problem problem{code, "", {}, nullptr};
  const std::string sentence = text;
  std::size_t at = 0;
  for (std::size_t open = sentence.find('{'); open != std::string::npos; open = sentence.find('{', at)) {
    const std::size_t close = sentence.find('}', open);
    const std::string placeholder = sentence.substr(open + 1, close - open - 1);
    const std::size_t colon = placeholder.find(':');
    const std::string spec = colon == std::string::npos ? "" : placeholder.substr(colon + 1);
    problem.text += sentence.substr(at, open - at);
    detail::add(detail::argument_of(placeholder.substr(0, colon), arguments), spec, problem);
    at = close + 1;
  }
  problem.text += sentence.substr(at);
  return problem;
}

/// Returns the problem and its causes, outermost first, as messages like mtr_msgs::Problem.
template <typename Message>
std::vector<Message> messages_of(const Problem& problem) {
  std::vector<Message> messages;
  for (const Problem* each = &problem; each != nullptr && *each; each = each->cause.get()) {
    Message message;
    message.code = each->code;
    message.text = each->text;
    for (const auto& [name, value] : each->arguments) {
      message.names.push_back(name);
      message.values.push_back(value);
    }
    messages.push_back(message);
  }
  return messages;
}

/// Returns the problem in messages of `messages_of`, or one with only the text if there are none.
template <typename Message>
Problem problem_of(const std::vector<Message>& messages, const std::string& text) {
  Problem problem;
  for (auto message = messages.rbegin(); message != messages.rend(); ++message) {
    Problem outer{message->code, message->text, {}, nullptr};
    for (std::size_t i = 0; i < message->names.size() && i < message->values.size(); ++i) {
      outer.arguments.emplace_back(message->names[i], message->values[i]);
    }
    outer.cause = problem ? std::make_shared<const Problem>(problem) : nullptr;
    problem = outer;
  }
  return problem ? problem : problem_with_text(text);
}

}  // namespace mtr_core
