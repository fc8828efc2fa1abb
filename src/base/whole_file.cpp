#include "base/whole_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace petzval {

Error unreadable(const std::string& path, int system_error) {
    constexpr std::array kLasting{ENOENT, ENOTDIR, EACCES, EPERM, EISDIR, ELOOP, ENAMETOOLONG, EINVAL};
    const bool lasts = std::find(kLasting.begin(), kLasting.end(), system_error) != kLasting.end();
    return {lasts ? ErrorCode::InvalidFile : ErrorCode::ReadFailed,
            path + ": cannot be read: " + std::generic_category().message(system_error)};
}

Result<std::string> text_of_file(const std::string& path, std::size_t most_bytes) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return unreadable(path, errno);
    std::string text;
    std::array<char, 1 << 14> buffer{};
    ssize_t got = 1;
    int error = 0;
    while (got > 0 && text.size() <= most_bytes) {
        got = ::read(file, buffer.data(), std::min(buffer.size(), most_bytes + 1 - text.size()));
        if (got > 0) text.append(buffer.data(), std::size_t(got));
        if (got < 0) error = errno;
        if (error == EINTR) error = 0, got = 1;
    }
    ::close(file);
    if (error != 0) return unreadable(path, error);
    return text;
}

}  // namespace petzval
