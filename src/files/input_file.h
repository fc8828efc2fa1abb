// A regular file opened for reading. Reads name their offset, so several readers share one open file; it
// stays readable after it is renamed over or deleted.
#pragma once

#include "petzval/result.h"
#include "petzval/workers.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace petzval {

class InputFile {
public:
    // Never blocks. Errors: InvalidFile if missing, without rights, empty, or a directory, pipe or device;
    // ReadFailed if the system fails otherwise.
    static Result<std::shared_ptr<const InputFile>> open(const std::string& path);
    // The same; "-" is standard input, which is read to its end, into memory, the first time it is asked for.
    // Waits for it, and throws Cancelled where `workers` are cancelled meanwhile. Errors: OutOfMemory for
    // more than most_bytes (0: 4 GiB).
    static Result<std::shared_ptr<const InputFile>> open_or_wait(const std::string& path,
                                                                 const Workers& workers,
                                                                 std::size_t most_bytes);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    // False if fewer than `bytes` bytes are there or the system failed: see failure().
    bool read_at(std::uint64_t offset, void* to, std::size_t bytes) const;
    // ReadFailed if the system failed to read, or the file has become shorter since it was opened. Decoders
    // pass no reasons, so this one takes precedence over theirs.
    std::optional<Error> failure() const;

    const std::string& path() const { return path_; }
    std::uint64_t bytes() const { return bytes_; }

private:
    InputFile(std::string path, int descriptor, std::uint64_t bytes);

    std::string path_;
    int descriptor_;
    std::uint64_t bytes_;
    mutable std::atomic<int> error_ = 0;  // of the last read that failed; kShortened: it ended too early
};

}  // namespace petzval
