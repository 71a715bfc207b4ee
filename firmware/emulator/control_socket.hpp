/// @file
/// UNIX socket with one line per question and one per answer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace emulator {

class ControlSocket {
 public:
  using Answer = std::function<std::string(const std::string& line)>;

  /// Throws std::system_error.
  ControlSocket(const std::string& path, Answer answer);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  /// Descriptors to wait for.
  std::vector<pollfd> descriptors() const;

  /// Accepts clients and answers what has arrived.
  void serve();

 private:
  void accept_clients();
  /// False when the client is gone.
  bool serve_client(int client, std::string* pending);

  std::string path_;
  Answer answer_;
  int listener_ = -1;
  /// What each client has sent of its next line.
  std::map<int, std::string> clients_;
};

}  // namespace emulator
