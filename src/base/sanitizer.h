// Reports the sanitizer that watches memory or threads: GCC and clang say so by different names.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define PETZVAL_ADDRESS_SANITIZER 1
#elif defined(__SANITIZE_THREAD__)
#define PETZVAL_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PETZVAL_ADDRESS_SANITIZER 1
#elif __has_feature(thread_sanitizer)
#define PETZVAL_THREAD_SANITIZER 1
#endif
#endif
