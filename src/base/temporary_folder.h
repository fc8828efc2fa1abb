// A folder for one test: CTest runs tests side by side, so no two of them may use the same file.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace petzval::test {

// The folder is new and empty, and it is removed with the object.
class TemporaryFolder {
public:
    TemporaryFolder() {
        // In memory where possible: thousands of small files are slow on a disk.
        const bool shm = ::access("/dev/shm", W_OK) == 0;
        std::string name =
            (shm ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/petzval-XXXXXX";
        folder_ = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(folder_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return folder_ + "/" + name; }
    std::string path() const { return folder_; }
    std::size_t files() const {
        std::size_t n = 0;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++n;
        return n;
    }

private:
    std::string folder_;
};

}  // namespace petzval::test
