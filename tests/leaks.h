/* Asks the leak sanitizer at a program's end, where its picture of the graphics driver is still whole: later the driver
 * is unloaded, and tests/lsan.supp does not know its leaks any more. Nothing in other builds. */
#ifndef TESTS_LEAKS_H
#define TESTS_LEAKS_H

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define CHECK_LEAKS __lsan_do_leak_check
#endif
#endif
#ifndef CHECK_LEAKS
#define CHECK_LEAKS() ((void)0)
#endif

#endif
