/// @file
/// Starts the drive control node.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/node.hpp"
#include "mtr_lockstep/run_node.hpp"

int main(int argc, char** argv) { return mtr_lockstep::run_node<mtr_drive_control::Node>(argc, argv, "drive_control"); }
