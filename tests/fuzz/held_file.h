// The bytes of one input as a file, for readers that take a path.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace petzval::fuzz {

// One file for the whole process, in memory where possible, written anew for every input.
inline std::string held_file(const std::uint8_t* bytes, std::size_t size, const std::string& suffix) {
    static const std::string path =
        (::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
        "/petzval-fuzz-" + std::to_string(::getpid()) + suffix;
    static const bool will_go = std::atexit([] { ::unlink(path.c_str()); }) == 0;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!will_go || !file || std::fwrite(bytes, 1, size, file) != size || std::fclose(file) != 0) {
        std::perror(path.c_str());
        std::_Exit(2);
    }
    return path;
}

// A message is one line and not empty.
inline void check_message(const std::string& message) {
    if (message.empty() || message.find('\n') != std::string::npos) {
        std::fprintf(stderr, "no clear line: '%s'\n", message.c_str());
        std::abort();
    }
}

}  // namespace petzval::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
