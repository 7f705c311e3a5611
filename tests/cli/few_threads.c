/* Loaded before a program (LD_PRELOAD), it lets the program start LORENTZ_FEW_THREADS threads, and no more. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) {
  static int left = -1;
  static int (*real)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (!real) {
    *(void**)&real = dlsym(RTLD_NEXT, "pthread_create");
    left = atoi(getenv("LORENTZ_FEW_THREADS"));
  }
  return left-- > 0 ? real(thread, attributes, work, argument) : EAGAIN;
}
