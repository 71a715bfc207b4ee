/// @file
/// Preloaded (LD_PRELOAD): a TCP socket that would listen on every address listens on loopback only.
///
/// roscpp binds the XML-RPC server of each node to every address regardless of ROS_IP, and any client of that server
/// can add a publisher to the node. Explicit addresses, as of the Operator's link, are unchanged, and so are UDP
/// sockets, to which LiDARs send.
// SPDX-License-Identifier: Apache-2.0
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstring>

namespace {

int option_of(int socket, int level, int name) {
  int value = 0;
  socklen_t length = sizeof value;
  return getsockopt(socket, level, name, &value, &length) == 0 ? value : -1;
}

in6_addr loopback_for(int socket) {
  if (option_of(socket, IPPROTO_IPV6, IPV6_V6ONLY) != 0) {
    return in6addr_loopback;
  }
  // It also serves IPv4: ::ffff:127.0.0.1, the address used by other nodes.
  in6_addr mapped = in6addr_any;
  mapped.s6_addr[10] = mapped.s6_addr[11] = 0xff;
  mapped.s6_addr[12] = 127;
  mapped.s6_addr[15] = 1;
  return mapped;
}

int bind_as_given(int socket, const void* address, socklen_t length) {
  return static_cast<int>(syscall(SYS_bind, socket, address, length));
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int bind(int socket, const sockaddr* address,
                                                           socklen_t length) noexcept {
  if (address == nullptr || option_of(socket, SOL_SOCKET, SO_TYPE) != SOCK_STREAM) {
    return bind_as_given(socket, address, length);
  }
  if (address->sa_family == AF_INET && length >= sizeof(sockaddr_in)) {
    sockaddr_in inner{};
    std::memcpy(&inner, address, sizeof inner);
    if (inner.sin_addr.s_addr == htonl(INADDR_ANY)) {
      inner.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      return bind_as_given(socket, &inner, sizeof inner);
    }
  }
  if (address->sa_family == AF_INET6 && length >= sizeof(sockaddr_in6)) {
    sockaddr_in6 inner{};
    std::memcpy(&inner, address, sizeof inner);
    if (IN6_IS_ADDR_UNSPECIFIED(&inner.sin6_addr)) {
      inner.sin6_addr = loopback_for(socket);
      return bind_as_given(socket, &inner, sizeof inner);
    }
  }
  return bind_as_given(socket, address, length);
}
