// A file that appears complete or not at all: written under another name beside its target, synced, renamed.
#pragma once

#include "petzval/result.h"

#include <cstdint>
#include <memory>
#include <string>

namespace petzval {

class OutputFile {
public:
    // "-.exr" and the like is standard output: kept in memory until commit(), as formats write back and
    // forth. Errors: OutputFailed if the folder is missing or not writable, the target is not a regular file,
    // or it exists and `overwrite` is false.
    static Result<std::unique_ptr<OutputFile>> create(const std::string& path, bool overwrite);
    // Removes the unfinished file unless commit() succeeded.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // After the first failure nothing more is written; commit() reports it.
    bool write_at(std::uint64_t offset, const void* from, std::size_t bytes);
    // Syncs and renames. Errors: OutputFailed with the system's reason; the target is untouched then.
    Status commit();

    const std::string& path() const { return path_; }
    bool failed() const { return error_ != 0; }
    Error error() const;

private:
    OutputFile() = default;
    Status rename_to_target();
    Status to_standard_output();
    static Result<std::unique_ptr<OutputFile>> standard_output(const std::string& path);

    std::string path_, target_, unfinished_path_;  // target_: path_ with links followed
    int descriptor_ = -1, error_ = 0, slot_ = -1;
    bool overwrite_ = true, committed_ = false, is_standard_output_ = false;
};

}  // namespace petzval
