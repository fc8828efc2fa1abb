#include "recent.h"

#include "petzval/output.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace petzval::view {
namespace {

constexpr std::size_t kMost = 12;

// Empty: there is no folder for it.
std::filesystem::path list_file() {
    const auto variable = [](const char* name) {
        const char* text = std::getenv(name);
        return std::filesystem::path(text ? text : "");
    };
    if (const auto state = variable("XDG_STATE_HOME"); state.is_absolute())
        return state / "petzval" / "recent";
    const auto home = variable("HOME");
    return home.is_absolute() ? home / ".local" / "state" / "petzval" / "recent" : std::filesystem::path();
}

}  // namespace

std::vector<std::string> recent_files() {
    std::vector<std::string> files;
    std::ifstream list(list_file());
    for (std::string line; files.size() < kMost && std::getline(list, line);)
        if (!line.empty()) files.push_back(line);
    return files;
}

void note_recent(const std::string& path) {
    std::error_code failed;
    const std::string whole = std::filesystem::absolute(path, failed).lexically_normal().string();
    const auto file = list_file();
    if (failed || file.empty() || whole.find('\n') != std::string::npos) return;
    std::vector<std::string> files = recent_files();
    if (!files.empty() && files.front() == whole) return;
    std::erase(files, whole);
    files.insert(files.begin(), whole);
    if (files.size() > kMost) files.resize(kMost);
    std::string text;
    for (const std::string& one : files) text += one + "\n";
    std::filesystem::create_directories(file.parent_path(), failed);
    if (!failed) static_cast<void>(write_text(file.string(), text));
}

}  // namespace petzval::view
