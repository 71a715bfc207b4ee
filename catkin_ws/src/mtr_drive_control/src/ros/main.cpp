/// @file
/// Starts the drive control node.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_core/run_node.hpp"
#include "mtr_drive_control/ros/node.hpp"

int main(int argc, char** argv) { return mtr_core::run_node<mtr_drive_control::Node>(argc, argv, "drive_control"); }
