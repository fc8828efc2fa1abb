// The memory that the system lets this process take: by a memory cgroup (containers, farms), or ulimit -v.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace petzval::cli {

struct MemoryLimit {
    std::size_t bytes = 0;  // that are left for work; 0: no limit, or none below the machine's memory
    std::string name;       // for messages
    std::string setting;    // what a user would change
    // The setting needed for work of that many bytes.
    std::function<std::size_t(std::size_t)> for_bytes;

    // Ends a message that says how much work takes, as "… at least 234M …": which setting is enough. Empty:
    // it says nothing of that.
    std::string enough(const std::string& message) const;
};

// threads: those that will work, each of which needs a stack.
MemoryLimit memory_limit(int threads);

}  // namespace petzval::cli
