/// @file
/// Non-blocking server of a few clients.
// SPDX-License-Identifier: Apache-2.0
#include "control_socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace emulator {
namespace {

constexpr int kWaitingClients = 4;

}  // namespace

ControlSocket::ControlSocket(const std::string& path, Answer answer) : path_(path), answer_(std::move(answer)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) {
    throw std::invalid_argument("The path of the control socket is too long: " + path_);
  }
  std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
  unlink(path_.c_str());
  listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0 || bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener_, kWaitingClients) != 0) {
    throw std::system_error(errno, std::generic_category(), path_);
  }
}

ControlSocket::~ControlSocket() {
  for (const auto& client : clients_) {
    close(client.first);
  }
  close(listener_);
  unlink(path_.c_str());
}

std::vector<pollfd> ControlSocket::descriptors() const {
  std::vector<pollfd> found = {{listener_, POLLIN, 0}};
  for (const auto& client : clients_) {
    found.push_back({client.first, POLLIN, 0});
  }
  return found;
}

void ControlSocket::serve() {
  accept_clients();
  for (auto client = clients_.begin(); client != clients_.end();) {
    if (serve_client(client->first, &client->second)) {
      ++client;
    } else {
      close(client->first);
      client = clients_.erase(client);
    }
  }
}

void ControlSocket::accept_clients() {
  int client;
  while ((client = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)) >= 0) {
    clients_[client];
  }
}

bool ControlSocket::serve_client(int client, std::string* pending) {
  std::array<char, 512> chunk;
  const ssize_t count = recv(client, chunk.data(), chunk.size(), 0);
  if (count <= 0) {
    return count < 0 && (errno == EAGAIN || errno == EINTR);
  }
  pending->append(chunk.data(), static_cast<std::size_t>(count));
  for (std::size_t end; (end = pending->find('\n')) != std::string::npos;) {
    const std::string reply = answer_(pending->substr(0, end)) + "\n";
    pending->erase(0, end + 1);
    if (send(client, reply.data(), reply.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(reply.size())) {
      return false;
    }
  }
  return true;
}

}  // namespace emulator
