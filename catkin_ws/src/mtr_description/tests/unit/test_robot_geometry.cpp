/// @file
/// Values from the robot's URDF, and sentences about invalid URDFs.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mtr_core/parameter.hpp"
#include "mtr_description/robot_geometry.hpp"

namespace mtr_description {
namespace {

std::string file(const std::string& path) {
  std::ifstream stream(path);
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

RobotGeometry shipped() { return RobotGeometry(file(ROBOT_URDF)); }

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  std::size_t at = old.empty() ? std::string::npos : text.find(old);
  EXPECT_TRUE(old.empty() || at != std::string::npos) << old;
  for (; at != std::string::npos; at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
  return text;
}

void ask(const std::string& urdf, const std::string& question) {
  const RobotGeometry geometry(urdf);
  const std::string frame = question.substr(question.find(' ') + 1);
  if (question.rfind("level", 0) == 0) {
    check_level(geometry.mount(frame));
  } else if (question.rfind("mount", 0) == 0) {
    geometry.mount(frame);
  } else if (question == "key") {
    geometry.key();
  } else if (question == "wheels") {
    geometry.wheels();
  } else if (question == "footprint") {
    geometry.footprint();
  }
}

std::string refusal_of(const std::string& urdf, const std::string& question) {
  try {
    ask(urdf, question);
  } catch (const mtr_core::ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotGeometry, LidarsLookForwardAndBack) {
  const Mount front = shipped().mount("front_lidar");
  const Mount rear = shipped().mount("rear_lidar");
  EXPECT_EQ(front.x_m, 0.12);
  EXPECT_EQ(front.yaw_rad, 0.0);
  EXPECT_EQ(rear.x_m, -0.2);
  EXPECT_EQ(rear.y_m, 0.0);
  EXPECT_EQ(rear.z_m, 0.2365);
  EXPECT_EQ(rear.yaw_rad, M_PI);
  EXPECT_NO_THROW(check_level(rear));
}

TEST(RobotGeometry, FootprintReachesToTheKeyAndTheFenders) {
  const Footprint footprint = shipped().footprint();
  EXPECT_EQ(footprint.front_m, 0.27);
  EXPECT_EQ(footprint.rear_m, 0.254);
  EXPECT_EQ(footprint.half_width_m, 0.215);
}

TEST(RobotGeometry, KeyHasLeverHeightAndTravel) {
  const KeyMount key = shipped().key();
  EXPECT_EQ(key.x_m, 0.25);
  EXPECT_EQ(key.y_m, 0.0);
  EXPECT_EQ(key.min_height_m, 0.35);
  EXPECT_EQ(key.max_height_m(), 1.55);
}

TEST(RobotGeometry, WheelsStandOnTheGround) {
  const Wheels wheels = shipped().wheels();
  EXPECT_EQ(wheels.base_m, 0.262);
  EXPECT_EQ(wheels.track_m, 0.37559);
  EXPECT_EQ(wheels.radius_m, 0.098);
  EXPECT_EQ(shipped().base_height_m(), 0.0635);
}

TEST(RobotGeometry, CentreOfMassRisesByTheShareOfWhatTheLiftCarries) {
  const double carried_kg = 0.8 + 0.08;
  const double robot_kg = 16.523 + 4 * 0.477 + 2 * 1.1 + 4.0 + carried_kg;
  const CentreOfMass low = shipped().centre_of_mass(0.0);
  const CentreOfMass high = shipped().centre_of_mass(1.2);
  EXPECT_NEAR(high.height_m - low.height_m, 1.2 * carried_kg / robot_kg, 1e-12);
  EXPECT_NEAR(low.x_m, (16.523 * 0.012 + 1.1 * (0.12 - 0.2) - 4.0 * 0.06 + 0.8 * 0.095 + 0.08 * 0.25) / robot_kg,
              1e-12);
  EXPECT_EQ(high.x_m, low.x_m);
}

TEST(RobotGeometry, TurnedMountOnATurnedMountIsComposed) {
  const std::string tail =
      R"(<link name="hub"/><joint name="hub_mount" type="fixed"><parent link="base_link"/><child link="hub"/>
         <origin xyz="-0.18 0.126 0" rpy="0 0 1.5707963267948966"/></joint>
         <link name="tip"/><joint name="tip_mount" type="fixed"><parent link="hub"/><child link="tip"/>
         <origin xyz="0.1 0 0" rpy="0.3 0 0"/></joint></robot>)";
  const Mount tip = RobotGeometry(replaced(file(ROBOT_URDF), "</robot>", tail)).mount("tip");
  EXPECT_NEAR(tip.x_m, -0.18, 1e-9);
  EXPECT_NEAR(tip.y_m, 0.226, 1e-9);
  EXPECT_NEAR(tip.roll_rad, 0.3, 1e-12);
  EXPECT_NEAR(tip.yaw_rad, M_PI / 2.0, 1e-12);
}

TEST(RobotGeometry, WhatCannotBeServedIsRefusedWithOneSentence) {
  std::istringstream lines(file(WRONG_ROBOTS));
  std::string line;
  int cases = 0;
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] == '#') {
      continue;
    }
    std::vector<std::string> column;
    std::istringstream columns(line);
    for (std::string text; std::getline(columns, text, '\t');) {
      column.push_back(text);
    }
    ASSERT_EQ(column.size(), 5U) << line;
    const std::string urdf = replaced(file(ROBOT_URDF), column[1], column[2]);
    EXPECT_EQ(refusal_of(urdf, column[3]), column[4]) << column[0];
    ++cases;
  }
  EXPECT_GT(cases, 10);
}

TEST(RobotGeometry, TextThatIsNoUrdfIsRefused) {
  EXPECT_EQ(refusal_of("robot", "key"), "Parameter robot_description cannot be read; allowed is a URDF.");
}

}  // namespace
}  // namespace mtr_description
