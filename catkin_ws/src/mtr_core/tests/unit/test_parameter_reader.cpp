/// @file
/// Reading, checking and reporting of parameters in C++, with the cases of the Python tests.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "mtr_core/parameter_reader.hpp"

namespace mtr_core {
namespace {

struct Example {
  double speed_mps = 0.5;
  double share = 0.2;
};

constexpr std::array<ParameterRow<Example>, 2> kRows{{
    {"speed_mps", &Example::speed_mps, 0.05, 2.0, "m/s"},
    {"share", &Example::share, 0.0, 1.0, ""},
}};

class Reading : public ::testing::Test {
 protected:
  std::string read() {
    ParameterReader reader(values);
    reader.read_numbers(kRows, numbers);
    reader.read("rear", rear);
    reader.read("topic", topic);
    reader.read("owners", owners);
    reader.read("source", source, {"own", "external"});
    return reader.finish();
  }

  std::string refusal() {
    try {
      read();
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  }

  XmlRpc::XmlRpcValue values;
  Example numbers;
  bool rear = true;
  std::string topic = "/wheels";
  std::vector<std::string> owners{"a", "b"};
  std::string source = "own";
};

TEST_F(Reading, NothingGivenTellsTheDefaultsInOneLineWithUnits) {
  EXPECT_EQ(read(), "speed_mps 0.5 m/s, share 0.2, rear true, topic /wheels, owners ['a', 'b'], source own");
}

TEST_F(Reading, GivenValuesReplaceDefaults) {
  values["speed_mps"] = 1;
  values["share"] = 0.25;
  values["rear"] = false;
  values["owners"][0] = std::string("c");
  values["source"] = std::string("external");
  EXPECT_EQ(read(), "speed_mps 1 m/s, share 0.25, rear false, topic /wheels, owners ['c'], source external");
  EXPECT_EQ(numbers.speed_mps, 1.0);
  EXPECT_EQ(owners, std::vector<std::string>{"c"});
}

TEST_F(Reading, TextThatIsNoneOrEmptyIsRefused) {
  values["topic"] = "";
  EXPECT_EQ(refusal(), "Parameter topic is ; allowed is a text.");
  values["topic"] = 3;
  EXPECT_EQ(refusal(), "Parameter topic is 3; allowed is a text.");
}

TEST_F(Reading, ValueThatSomebodyElseReadsIsNotUnknown) {
  values["linear"] = 3;
  ParameterReader reader(values);
  reader.ignore({"linear"});
  EXPECT_EQ(reader.finish(), "");
}

TEST_F(Reading, UnknownNameIsRefusedWithThoseAllowed) {
  values["spead_mps"] = 1.0;
  EXPECT_EQ(refusal(), "Parameter spead_mps is unknown; allowed are owners, rear, share, source, speed_mps, topic.");
}

TEST_F(Reading, TextForANumberIsRefusedWithWhatIsAllowed) {
  values["speed_mps"] = std::string("fast");
  EXPECT_EQ(refusal(), "Parameter speed_mps is fast; allowed is a number, 0.05 to 2 m/s.");
}

TEST_F(Reading, TruthForANumberIsRefused) {
  values["share"] = true;
  EXPECT_EQ(refusal(), "Parameter share is 1; allowed is a number, 0 to 1.");
}

TEST_F(Reading, NumberForASwitchIsRefused) {
  values["rear"] = 1;
  EXPECT_EQ(refusal(), "Parameter rear is 1; allowed is true or false.");
}

TEST_F(Reading, ListWithANumberIsRefused) {
  values["owners"][0] = 5;
  EXPECT_EQ(refusal(), "Parameter owners is {5}; allowed is a list of texts.");
}

TEST_F(Reading, TextThatIsNoneOfTheChoicesIsRefusedWithThem) {
  values["source"] = std::string("gps");
  EXPECT_EQ(refusal(), "Parameter source is gps; allowed is external or own.");
}

TEST_F(Reading, NumberOutOfRangeIsRefusedWithValueAndRange) {
  values["speed_mps"] = 3;
  EXPECT_EQ(refusal(), "Parameter speed_mps is 3 m/s; allowed is 0.05 to 2 m/s.");
}

TEST_F(Reading, NotANumberIsRefused) {
  values["share"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(), "Parameter share is nan; allowed is 0 to 1.");
}

}  // namespace
}  // namespace mtr_core
