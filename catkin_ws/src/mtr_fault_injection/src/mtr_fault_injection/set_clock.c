/* Library that is preloaded into the robot's processes: it adds an offset from a shared file to the wall clock.
 *
 * The clock of a machine with other users cannot be set. libfaketime reads its file only once a second, or parses it at
 * each call. Here the file is shared memory, so that one write sets the clock of all processes at the same instant. A
 * process that waits for a time of this clock wakes as with the kernel's clock. Steady clocks are unchanged.
 * SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define SECOND_NS 1000000000LL
/* Period in which a waiting thread checks whether the clock was set. */
#define SLICE_NS 20000000LL
/* Earlier deadlines belong to a condition on the steady clock, which counts from the machine's start. */
#define OLDEST_WALL_S 1000000000LL

static const int64_t zero;
static const volatile int64_t *offset_ns = &zero;

__attribute__((constructor)) static void attach(void) {
  const char *path = getenv("MTR_CLOCK_OFFSET_FILE");
  const int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (file >= 0) {
    void *shared = mmap(0, sizeof(int64_t), PROT_READ, MAP_SHARED, file, 0);
    if (shared != MAP_FAILED) {
      offset_ns = (const volatile int64_t *)shared;
    }
    close(file);
  }
}

static int64_t ns_of(const struct timespec *time) { return time->tv_sec * SECOND_NS + time->tv_nsec; }

static struct timespec time_of(int64_t ns) {
  struct timespec time = {ns / SECOND_NS, ns % SECOND_NS};
  return time;
}

static int64_t now_ns(clockid_t clock) {
  struct timespec time;
  syscall(SYS_clock_gettime, clock, &time);
  return ns_of(&time) + (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE ? *offset_ns : 0);
}

int clock_gettime(clockid_t clock, struct timespec *time) {
  const int failed = (int)syscall(SYS_clock_gettime, clock, time);
  if (!failed && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
    *time = time_of(ns_of(time) + *offset_ns);
  }
  return failed;
}

int gettimeofday(struct timeval *time, void *zone) {
  (void)zone;
  const int64_t ns = now_ns(CLOCK_REALTIME);
  time->tv_sec = ns / SECOND_NS;
  time->tv_usec = ns % SECOND_NS / 1000;
  return 0;
}

time_t time(time_t *seconds) {
  const time_t now = (time_t)(now_ns(CLOCK_REALTIME) / SECOND_NS);
  if (seconds) {
    *seconds = now;
  }
  return now;
}

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until) {
  if (until->tv_sec < OLDEST_WALL_S) {
    return pthread_cond_clockwait(condition, mutex, CLOCK_MONOTONIC, until);
  }
  for (;;) {
    const int64_t left_ns = ns_of(until) - now_ns(CLOCK_REALTIME);
    const struct timespec slice =
        time_of(now_ns(CLOCK_MONOTONIC) + (left_ns < 0 ? 0 : left_ns < SLICE_NS ? left_ns : SLICE_NS));
    const int result = pthread_cond_clockwait(condition, mutex, CLOCK_MONOTONIC, &slice);
    if (result != ETIMEDOUT || left_ns <= 0) {
      return result;
    }
  }
}

int sem_timedwait(sem_t *semaphore, const struct timespec *until) {
  for (;;) {
    const int64_t left_ns = ns_of(until) - now_ns(CLOCK_REALTIME);
    const struct timespec slice =
        time_of(now_ns(CLOCK_MONOTONIC) + (left_ns < 0 ? 0 : left_ns < SLICE_NS ? left_ns : SLICE_NS));
    if (!sem_clockwait(semaphore, CLOCK_MONOTONIC, &slice)) {
      return 0;
    }
    if (errno != ETIMEDOUT || left_ns <= 0) {
      return -1;
    }
  }
}
