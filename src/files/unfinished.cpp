#include "files/unfinished.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <set>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace petzval {
namespace {

constexpr std::string_view kEnding = ".unfinished";

bool all_digits(std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_ours(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(kEnding)) return false;
    name.remove_suffix(kEnding.size());
    const std::size_t dot = name.rfind('.');
    const std::string_view number = name.substr(dot + 1);
    const std::size_t dash = number.find('-');
    return dot > 0 && dash != std::string_view::npos && all_digits(number.substr(0, dash)) &&
           all_digits(number.substr(dash + 1));
}

// A process may be another machine's or another container's: its number says nothing, its lock does. Where a
// file system has no locks, nothing is removed.
void remove_if_left(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    struct stat status = {};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
        ::flock(file, LOCK_EX | LOCK_NB) == 0)
        ::unlink(path.c_str());
    ::close(file);
}

}  // namespace

std::string unfinished_name(const std::string& name) {
    static std::atomic<unsigned> counter{0};
    return "." + name.substr(0, 200) + "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
           std::string(kEnding);
}

bool claim_unfinished(int descriptor) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat status = {};
    return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

void remove_leftovers(const std::string& folder) {
    static std::mutex mutex;
    static std::set<std::string> seen;
    {
        const std::lock_guard lock(mutex);
        if (!seen.insert(folder).second) return;
    }
    std::error_code failed;
    for (std::filesystem::directory_iterator i(folder, failed), end; !failed && i != end; i.increment(failed))
        if (const std::string name = i->path().filename().string(); is_ours(name))
            remove_if_left(i->path().string());
}

}  // namespace petzval
