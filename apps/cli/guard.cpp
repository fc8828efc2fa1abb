#include "guard.h"

#include "console/console.h"

#include <filesystem>

namespace petzval::cli {
namespace {

bool g_never_replaces = false;

}  // namespace

RunFiles& run_files() {
    static RunFiles files;
    return files;
}

Status may_write(const std::vector<std::string>& outputs) {
    for (const std::string& path : outputs) run_files().writes(path);
    return run_files().check();
}

void never_replace() { g_never_replaces = true; }
bool never_replaces() { return g_never_replaces; }

bool is_left_alone(const std::string& path) {
    std::error_code missing;
    if (!g_never_replaces || path.empty() || !std::filesystem::exists(path, missing)) return false;
    note(path + ": exists and is kept (--no-clobber)");
    return true;
}

}  // namespace petzval::cli
