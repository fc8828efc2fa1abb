#include "files/input_file.h"

#include "base/cancel.h"
#include "base/whole_file.h"
#include "files/wording.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace petzval {
namespace {

constexpr int kShortened = -1;

}  // namespace

InputFile::InputFile(std::string path, int descriptor, std::uint64_t bytes)
    : path_(std::move(path)), descriptor_(descriptor), bytes_(bytes) {}

InputFile::~InputFile() { ::close(descriptor_); }

Result<std::shared_ptr<const InputFile>> InputFile::open(const std::string& path) {
    // O_NONBLOCK: opening a pipe nobody writes to would wait for ever.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return unreadable(printable(path, 4096), errno);
    struct stat status = {};
    const bool known = ::fstat(descriptor, &status) == 0;
    std::shared_ptr<const InputFile> file(
        new InputFile(path, descriptor, known ? std::uint64_t(status.st_size) : 0));
    if (known && S_ISDIR(status.st_mode))
        return invalid_file(path, "is a directory; an .exr or .png file is needed");
    if (!known || !S_ISREG(status.st_mode))
        return invalid_file(path, "is not a regular file; pipes and devices cannot be read");
    if (status.st_size == 0) return invalid_file(path, "is empty (0 bytes)");
    return file;
}

namespace {

Error wrong_input(const char* why) { return invalid_file("standard input", why); }

// All of standard input as a file in memory, of so many bytes: its descriptor.
Result<int> standard_input(const Workers& workers, std::uint64_t most, std::uint64_t& bytes) {
    if (::isatty(STDIN_FILENO)) return wrong_input("is a terminal; a picture is needed");
    const int file = ::memfd_create("standard input", MFD_CLOEXEC);
    if (file < 0) return unreadable("standard input", errno);
    const auto given_up = [&](const Error& why) {
        ::close(file);
        return why;
    };
    std::array<char, 1 << 16> buffer{};
    for (;;) {
        constexpr int kAskEveryMs = 100;
        pollfd waiting{STDIN_FILENO, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, kAskEveryMs);
        try {
            check_cancelled(workers);
        } catch (...) {
            ::close(file);
            throw;
        }
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return given_up(unreadable("standard input", errno));
        if (got == 0) return file;
        bytes += std::uint64_t(got);
        if (bytes > most)
            return given_up({ErrorCode::OutOfMemory, "standard input holds more than " + byte_count(most) +
                                                         ", the limit for reading it; give a file"});
        if (::write(file, buffer.data(), std::size_t(got)) != got)
            return given_up({ErrorCode::OutOfMemory, "standard input does not fit into memory; give a file"});
    }
}

}  // namespace

Result<std::shared_ptr<const InputFile>> InputFile::open_or_wait(const std::string& path,
                                                                 const Workers& workers,
                                                                 std::size_t most_bytes) {
    if (path != "-") return open(path);
    static std::mutex mutex;
    static std::shared_ptr<const InputFile> read;  // it can be read once
    const std::lock_guard lock(mutex);
    if (read) return read;
    std::uint64_t bytes = 0;
    const auto file = standard_input(workers, most_bytes > 0 ? most_bytes : std::uint64_t(1) << 32, bytes);
    if (!file) return file.error();
    std::shared_ptr<const InputFile> all(new InputFile("standard input", *file, bytes));
    if (bytes == 0) return wrong_input("is empty (0 bytes)");
    return read = all;
}

bool InputFile::read_at(std::uint64_t offset, void* to, std::size_t bytes) const {
    if (offset > bytes_ || bytes > bytes_ - offset) return false;
    char* out = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got = ::pread(descriptor_, out, bytes, off_t(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            error_ = got < 0 ? errno : kShortened;
            return false;
        }
        out += got, offset += std::uint64_t(got), bytes -= std::size_t(got);
    }
    return true;
}

std::optional<Error> InputFile::failure() const {
    const std::string path = printable(path_, 4096);
    if (error_ == kShortened)
        return Error{ErrorCode::ReadFailed, path + ": became shorter while it was read"};
    if (error_ != 0) return Error{ErrorCode::ReadFailed, unreadable(path, error_).message};
    return std::nullopt;
}

}  // namespace petzval
