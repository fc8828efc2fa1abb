#include "sequence/video.h"

#include "petzval/shots/shot_sheet.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to us

namespace petzval::sequence {
namespace {

namespace fs = std::filesystem;

struct Container {
    const char *extension, *format, *codec;
};
constexpr Container kContainers[] = {{".mp4", "mp4", "libx264"},
                                     {".mov", "mov", "libx264"},
                                     {".mkv", "matroska", "libx264"},
                                     {".webm", "webm", "libvpx-vp9"}};

const Container* container_of(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    const auto* const found = std::find_if(std::begin(kContainers), std::end(kContainers),
                                           [&](const Container& c) { return extension == c.extension; });
    return found == std::end(kContainers) ? nullptr : found;
}

}  // namespace

Status Video::failed(const std::string& why) const {
    return Error{ErrorCode::OutputFailed, path_ + ": " + why};
}

Video::~Video() {
    if (pipe_ >= 0) close(pipe_);
    if (process_ > 0) {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    if (!unfinished_.empty()) unlink(unfinished_.c_str());
}

Status Video::open(const std::string& path, int width, int height, double frames_per_second) {
    path_ = path;
    const fs::path place(path);
    // Named like other unfinished files, so that the next run removes it after a crash.
    unfinished_ = (place.parent_path() /
                   ("." + place.filename().string() + "." + std::to_string(getpid()) + "-0.unfinished"))
                      .string();
    const Container& container = *container_of(path);
    std::vector<std::string> words{"ffmpeg",
                                   "-y",
                                   "-loglevel",
                                   "error",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "rgb24",
                                   "-s",
                                   std::to_string(width) + "x" + std::to_string(height),
                                   "-framerate",
                                   std::to_string(frames_per_second),
                                   "-i",
                                   "pipe:0",
                                   "-c:v",
                                   container.codec,
                                   "-crf",
                                   "18",
                                   "-pix_fmt",
                                   "yuv420p",
                                   "-f",
                                   container.format,
                                   "file:" + unfinished_};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return failed(std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    // Ctrl-C in a terminal reaches a whole group; what becomes of the video is ours to say.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = -1;
    const int error = posix_spawnp(&process, "ffmpeg", &actions, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(ends[0]);
    if (error != 0) {
        close(ends[1]);
        return failed(error == ENOENT
                          ? "a video needs ffmpeg, which is not installed; .png makes a contact sheet"
                          : std::strerror(error));
    }
    process_ = process, pipe_ = ends[1];
    std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that ends early is an error of write()
    return Done{};
}

Status Video::add(const std::vector<std::uint8_t>& rgb) {
    std::size_t at = 0;
    while (at < rgb.size()) {
        const ssize_t written = write(pipe_, rgb.data() + at, rgb.size() - at);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return failed("ffmpeg ended early");
        at += std::size_t(written);
    }
    return Done{};
}

Status Video::finish() {
    close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return failed("ffmpeg could not make it");
    if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) return failed(std::strerror(errno));
    unfinished_.clear();
    return Done{};
}

}  // namespace petzval::sequence

bool petzval::is_video(const std::string& path) { return sequence::container_of(path) != nullptr; }
