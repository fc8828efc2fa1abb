// Shared by the programs of `./dev bench`: their exit on errors, their CPU time and memory.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace petzval::bench {

// One line that names the program; exit code 2.
[[noreturn]] inline void fail(const std::string& message) {
    std::fprintf(stderr, "%s: %s\n", program_invocation_short_name, message.c_str());
    std::exit(2);
}

// CPU time of all threads since the program began.
inline double cpu_seconds() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace petzval::bench
