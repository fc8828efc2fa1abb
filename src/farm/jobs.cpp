#include "petzval/farm/jobs.h"

#include "petzval/frames.h"
#include "petzval/output.h"

#include "farm/writers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <span>

#include <nlohmann/json.hpp>

namespace petzval {
namespace {

constexpr double kSecondsPerChunk = 60;
constexpr std::size_t kLeastMemory = std::size_t(256) << 20;

Error refused(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// No system needs to quote what these characters cannot spell.
Status check(const FarmShot& shot) {
    const auto is_bad = [](const std::string& word) {
        return word.find_first_of("\n\r") != std::string::npos || word.find('\0') != std::string::npos;
    };
    if (shot.frames.empty()) return refused("no frames");
    if (std::any_of(shot.command.begin(), shot.command.end(), is_bad) || is_bad(shot.working_folder))
        return refused("a job for a farm cannot have a line break in an argument or in the folder's name");
    // run.sh and its folder stand in templates, shell lines and XML.
    const auto is_plain = [](unsigned char c) {
        return c >= 0x80 || std::isalnum(c) ||
               std::string_view("/._-+,=@ ").find(char(c)) != std::string::npos;
    };
    if (!std::all_of(shot.folder.begin(), shot.folder.end(), is_plain))
        return refused(shot.folder +
                       ": the folder of a job may contain only letters, digits, blanks and /._-+,=@");
    return Done{};
}

}  // namespace

const std::vector<std::pair<std::string, FarmSystem>>& farm_systems() {
    static const std::vector<std::pair<std::string, FarmSystem>> systems{{"list", FarmSystem::List},
                                                                         {"slurm", FarmSystem::Slurm},
                                                                         {"flamenco", FarmSystem::Flamenco},
                                                                         {"openjd", FarmSystem::OpenJd},
                                                                         {"opencue", FarmSystem::OpenCue}};
    return systems;
}

FarmShot farm_shot_in(const std::string& folder) {
    namespace fs = std::filesystem;
    FarmShot shot;
    shot.folder = fs::absolute(folder).lexically_normal().string();
    if (shot.folder.ends_with("/")) shot.folder.pop_back();
    shot.name = farm_job_name(shot.folder);
    shot.working_folder = fs::current_path().string();
    return shot;
}

void set_cost(FarmShot& shot, double seconds_per_frame, std::size_t peak_memory_bytes) {
    shot.seconds_per_frame = seconds_per_frame;
    if (shot.memory_bytes == 0) shot.memory_bytes = std::max(peak_memory_bytes / 4 * 5, kLeastMemory);
    shot.chunk = farm_chunk(seconds_per_frame, shot.frames.size());
}

std::string farm_job_name(const std::string& folder) {
    std::string name = std::filesystem::path(folder).filename().string();
    const auto is_odd = [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '-'; };
    std::replace_if(name.begin(), name.end(), is_odd, '_');
    return name.size() < 3 ? "petzval_" + name : name;
}

int farm_chunk(double seconds_per_frame, std::size_t frames) {
    const double most = double(std::max<std::size_t>(frames, 1));
    return int(std::clamp(std::floor(kSecondsPerChunk / seconds_per_frame), 1.0, most));
}

Result<std::vector<FarmFile>> farm_files(const FarmShot& shot, FarmSystem system) {
    if (Status fine = check(shot); !fine) return fine.error();
    const auto write = [&]() -> Result<FarmFile> {
        switch (system) {
            case FarmSystem::List:
                return farm::list_file(shot);
            case FarmSystem::Slurm:
                return farm::slurm_file(shot);
            case FarmSystem::Flamenco:
                return farm::flamenco_file(shot);
            case FarmSystem::OpenJd:
                return farm::openjd_file(shot);
            case FarmSystem::OpenCue:
                break;
        }
        return farm::opencue_file(shot);
    };
    auto file = write();
    if (!file) return file.error();
    return std::vector<FarmFile>{
        {"shot.json", farm::shot_json(shot)}, {"run.sh", farm::run_script(shot), true}, std::move(*file)};
}

Result<std::string> write_farm_file(const FarmShot& shot, const FarmFile& file) {
    namespace fs = std::filesystem;
    std::string path = shot.folder + "/" + file.name;
    if (Status done = write_text(path, file.text); !done) return done.error();
    if (!file.is_program) return path;
    std::error_code error;
    fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                    fs::perm_options::add, error);
    if (error) return Error{ErrorCode::OutputFailed, path + ": " + error.message()};
    return path;
}

std::vector<std::string> farm::chunks(const FarmShot& shot, int size) {
    std::vector<std::string> lists;
    const std::span<const int> all(shot.frames);
    for (std::size_t first = 0; first < all.size(); first += std::size_t(size))
        lists.push_back(frames_text(all.subspan(first, std::min(std::size_t(size), all.size() - first))));
    return lists;
}

bool farm::is_without_gaps(const std::vector<int>& frames) {
    return frames.back() - frames.front() + 1 == int(frames.size());
}

std::size_t farm::memory_mib(const FarmShot& shot) { return (shot.memory_bytes + (1u << 20) - 1) >> 20; }

std::string farm::shot_json(const FarmShot& shot) {
    const nlohmann::ordered_json facts{
        {"name", shot.name},       {"working_folder", shot.working_folder},
        {"command", shot.command}, {"frames", frames_text(shot.frames)},
        {"chunk", shot.chunk},     {"seconds_per_frame", shot.seconds_per_frame},
        {"threads", shot.threads}, {"memory_bytes", shot.memory_bytes},
        {"input", shot.input},     {"output", shot.output},
        {"look", shot.look},       {"track", shot.track}};
    return facts.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace petzval
