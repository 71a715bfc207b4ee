/* Preloaded into a node: each read of a socket takes 1 ms longer in all threads but the first, as on a busy machine.
 * SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

ssize_t recv(int socket, void* buffer, size_t length, int flags) {
  static ssize_t (*next)(int, void*, size_t, int);
  if (!next) {
    next = (ssize_t(*)(int, void*, size_t, int))dlsym(RTLD_NEXT, "recv");
  }
  const ssize_t received = next(socket, buffer, length, flags);
  if (syscall(SYS_gettid) != getpid()) {
    usleep(1000);
  }
  return received;
}
