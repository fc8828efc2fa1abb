#include "petzval/shot_run.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace petzval {
namespace {

namespace fs = std::filesystem;

std::size_t page_bytes() { return std::size_t(::sysconf(_SC_PAGESIZE)); }
std::size_t machine_bytes() { return std::size_t(::sysconf(_SC_PHYS_PAGES)) * page_bytes(); }

// The n-th number of /proc/self/statm, in bytes: 0 the address space, 1 what is resident.
std::size_t own_bytes(int n) {
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    for (int i = 0; i <= n; ++i) file >> pages;
    return file ? pages * page_bytes() : 0;
}

std::optional<std::size_t> number_in(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return std::size_t(number);
    return std::nullopt;  // missing, or "max"
}

// Bytes held by others in a group; file pages are released when memory runs short.
std::size_t held_by_others(const fs::path& group) {
    std::ifstream file(group / "memory.stat");
    std::size_t held = 0;
    std::uint64_t bytes = 0;
    for (std::string key; file >> key >> bytes;)
        if (key == "anon" || key == "total_rss") held = std::size_t(bytes);
    return held - std::min(held, own_bytes(1));
}

// The tightest limit from a group up to the root of its tree: that of each holds for all groups in it.
void tighten(const fs::path& root, const std::string& group, const char* limit_file, MemoryLimit& limit) {
    for (fs::path at = root / fs::path(group).relative_path();; at = at.parent_path()) {
        const auto most = number_in(at / limit_file);
        if (most && *most < machine_bytes()) {
            const std::size_t left = *most - std::min(*most - 1, held_by_others(at));
            if (limit.bytes == 0 || left < limit.bytes)
                limit = {left, "the limit of the memory cgroup", limit_file,
                         [others = *most - left](std::size_t bytes) { return others + bytes; }};
        }
        if (at == root || at.native().size() <= root.native().size()) return;
    }
}

// "0::/a/b" of version 2, "4:memory:/a/b" of version 1.
void tighten_by_cgroups(MemoryLimit& limit) {
    std::ifstream file("/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",",
                          group = line.substr(second + 1);
        if (line.starts_with("0::"))
            tighten("/sys/fs/cgroup", group, "memory.max", limit);
        else if (controllers.find(",memory,") != std::string::npos)
            tighten("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes", limit);
    }
}

// Addresses run out before memory does: each thread reserves a stack and an arena of malloc, and lists
// reserve more than they fill (a frame of 2560 x 1440 took 579 MB of addresses and 217 MB of memory).
void tighten_by_ulimit(int threads, MemoryLimit& limit) {
    constexpr std::size_t kPerThread = std::size_t(72) << 20;
    constexpr double kAddressesPerByte = 1.6;
    rlimit most{};
    if (::getrlimit(RLIMIT_AS, &most) != 0 || most.rlim_cur == RLIM_INFINITY) return;
    const std::size_t all = std::size_t(most.rlim_cur),
                      taken = own_bytes(0) + std::size_t(threads) * kPerThread;
    if (all >= machine_bytes()) return;
    const auto left = std::size_t(double(all - std::min(all - 1, taken)) / kAddressesPerByte) + 1;
    if (limit.bytes > 0 && left >= limit.bytes) return;
    limit = {left, "what ulimit -v leaves", "ulimit -v",
             [taken](std::size_t bytes) { return taken + std::size_t(kAddressesPerByte * double(bytes)); }};
}

}  // namespace

std::string MemoryLimit::enough(const std::string& message) const {
    const std::string before = "at least ";
    const std::size_t at = message.rfind(before);
    std::size_t mebibytes = 0;
    if (at == std::string::npos || !(std::istringstream(message.substr(at + before.size())) >> mebibytes))
        return "";
    const std::size_t high = for_bytes((mebibytes + 1) << 20);
    const std::string number =
        setting == "ulimit -v" ? std::to_string((high >> 10) + 1) : std::to_string((high >> 20) + 1) + "M";
    return setting + " " + number + " would be enough";
}

MemoryLimit memory_limit(int threads) {
    MemoryLimit limit;
    tighten_by_cgroups(limit);
    tighten_by_ulimit(threads > 0 ? threads : int(std::max(1u, std::thread::hardware_concurrency())), limit);
    return limit;
}

}  // namespace petzval
