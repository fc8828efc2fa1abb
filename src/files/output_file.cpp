#include "files/output_file.h"

#include "petzval/output.h"

#include "files/unfinished.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace petzval {
namespace {

// Names of unfinished files in memory that never moves, so that a signal handler may read them. A slot is
// written only while `state` says Filling, and a handler looks only at slots that say Ready.
enum SlotState : int { Free, Filling, Ready };
struct Slot {
    std::atomic<int> state{Free};
    std::array<char, 4096> path{};
};
std::array<Slot, 16> unfinished;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads the slots");

// Returns the slot, or -1 when the path is too long or all slots are taken: the file is then only removed by
// ~OutputFile.
int remember(const std::string& path) {
    if (path.size() >= unfinished[0].path.size()) return -1;
    for (std::size_t i = 0; i < unfinished.size(); ++i) {
        int expected = Free;
        if (!unfinished[i].state.compare_exchange_strong(expected, Filling)) continue;
        std::memcpy(unfinished[i].path.data(), path.c_str(), path.size() + 1);
        unfinished[i].state.store(Ready);
        return int(i);
    }
    return -1;
}

void forget(int slot) {
    if (slot >= 0) unfinished[std::size_t(slot)].state.store(Free);
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

// The path with links followed, also to missing targets: writing through a link keeps the link. A result that
// is still a link leads to itself.
std::filesystem::path followed(std::filesystem::path path) {
    constexpr int kMostLinks = 40;  // as Linux has it
    std::error_code failed;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(path, failed); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, failed);
    return path;
}

// Destination of an output.
struct Target {
    std::string path;  // links followed
    bool exists = false;
    mode_t mode = 0666;

    std::string folder() const { return folder_of(path); }
    std::string name() const { return path.substr(path.rfind('/') + 1); }
};

// Errors: OutputFailed for paths that cannot be written.
Result<Target> target_of(const std::string& path) {
    if (path.empty()) return output_failed("(no name)", "an output file needs a name");
    std::error_code failed;
    Target target{followed(path).string()};
    if (std::filesystem::is_symlink(target.path, failed))
        return output_failed(path, "is a link that leads to itself; give the name of a file");
    struct stat status = {};
    target.exists = ::stat(target.path.c_str(), &status) == 0;
    if (!target.exists) return target;
    if (S_ISDIR(status.st_mode)) return output_failed(path, "is a folder; a file name is needed");
    if (!S_ISREG(status.st_mode))
        return output_failed(path, "is a pipe or device; only regular files can be written");
    target.mode = status.st_mode & 0777;
    // Renaming replaces even a read-only file; someone who protected it does not expect that.
    if (::access(target.path.c_str(), W_OK) != 0) return output_failed(path, std::strerror(errno));
    return target;
}

// "-" itself is for text alone: of a picture the ending says what it is.
bool is_standard_output(const std::string& path) { return path == "-" || path.starts_with("-."); }

// The same text for all names of one file, links and hard links among them; of a file that is not there yet
// the path it will have.
std::string identity(const std::string& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0)
        return "#" + std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
    std::error_code missing;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(followed(path), missing), missing)
        .string();
}

bool is_file_name(const std::string& path) { return !path.empty() && !is_standard_output(path); }

// Checks that a file can be written there.
Status check_target(const std::string& path) {
    const auto target = target_of(path);
    if (!target) return target.error();
    const std::string folder = target->folder();
    struct stat status = {};
    if (::stat(folder.c_str(), &status) != 0)
        return output_failed(path, "cannot be written: no such folder: " + folder);
    if (!S_ISDIR(status.st_mode))
        return output_failed(path, "cannot be written: " + folder + " is not a folder");
    // The file is replaced by renaming, so that the folder is what must be writable.
    if (::access(folder.c_str(), W_OK) != 0)
        return output_failed(path, "cannot be written: " + std::string(std::strerror(errno)));
    return Done{};
}

}  // namespace

void remove_unfinished_outputs() {
    const int saved_errno = errno;
    for (Slot& slot : unfinished)
        if (slot.state.load() == Ready) ::unlink(slot.path.data());
    errno = saved_errno;
}

Result<std::unique_ptr<OutputFile>> OutputFile::standard_output(const std::string& path) {
    std::unique_ptr<OutputFile> file(new OutputFile);
    file->path_ = "standard output";
    file->is_standard_output_ = true;
    if (::isatty(STDOUT_FILENO))
        return output_failed(path, "is standard output, a terminal; a picture is for a pipe or a file");
    file->descriptor_ = ::memfd_create("standard output", MFD_CLOEXEC);
    if (file->descriptor_ < 0) return output_failed(path, std::strerror(errno));
    return file;
}

Status OutputFile::to_standard_output() {
    std::array<char, 1 << 16> buffer{};
    ssize_t got = 0;
    ::lseek(descriptor_, 0, SEEK_SET);
    while (error_ == 0 && (got = ::read(descriptor_, buffer.data(), buffer.size())) > 0)
        for (const char* from = buffer.data(); got > 0 && error_ == 0;) {
            const ssize_t put = ::write(STDOUT_FILENO, from, std::size_t(got));
            if (put < 0 && errno != EINTR) error_ = errno;
            if (put > 0) from += put, got -= put;
        }
    return error_ == 0 ? Status(Done{}) : error();
}

Result<std::unique_ptr<OutputFile>> OutputFile::create(const std::string& path, bool overwrite) {
    if (is_standard_output(path)) return standard_output(path);
    const auto target = target_of(path);
    if (!target) return target.error();
    if (target->exists && !overwrite) return output_failed(path, "exists already and may not be overwritten");
    std::unique_ptr<OutputFile> file(new OutputFile);
    file->path_ = path;
    file->target_ = target->path;
    file->overwrite_ = overwrite;
    remove_leftovers(target->folder());
    for (int attempt = 0; attempt < 100 && file->descriptor_ < 0; ++attempt) {
        file->unfinished_path_ = target->folder() + "/" + unfinished_name(target->name());
        file->descriptor_ =
            ::open(file->unfinished_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, target->mode);
        if (file->descriptor_ < 0 && errno != EEXIST)
            return output_failed(path, "cannot be written: " + std::string(std::strerror(errno)));
        if (file->descriptor_ >= 0 && !claim_unfinished(file->descriptor_))
            ::close(std::exchange(file->descriptor_, -1));
    }
    if (file->descriptor_ < 0) return output_failed(path, "cannot be written: no free name beside it");
    file->slot_ = remember(file->unfinished_path_);
    return file;
}

OutputFile::~OutputFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (is_standard_output_) return;
    if (!committed_) ::unlink(unfinished_path_.c_str());
    forget(slot_);
}

bool OutputFile::write_at(std::uint64_t offset, const void* from, std::size_t bytes) {
    const char* in = static_cast<const char*>(from);
    while (bytes > 0 && error_ == 0) {
        const ssize_t put = ::pwrite(descriptor_, in, bytes, off_t(offset));
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) {
            error_ = put < 0 ? errno : ENOSPC;
            break;
        }
        in += put, offset += std::uint64_t(put), bytes -= std::size_t(put);
    }
    return error_ == 0;
}

Error OutputFile::error() const {
    return output_failed(path_, "cannot be written: " + std::string(std::strerror(error_)));
}

Status OutputFile::commit() {
    if (is_standard_output_) return error_ == 0 ? to_standard_output() : Status(error());
    if (error_ == 0 && ::fsync(descriptor_) != 0) error_ = errno;
    if (error_ != 0) return error();
    if (Status renamed = rename_to_target(); !renamed) return renamed;
    committed_ = true;
    // The rename itself must reach the disk too; where a folder cannot be synced there is nothing to do about
    // it.
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
    return Done{};
}

Status OutputFile::rename_to_target() {
    const char *from = unfinished_path_.c_str(), *to = target_.c_str();
    if (!overwrite_) {
        // Decided by the file system itself: someone else may have written the file since create().
        if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return Done{};
        if (errno == EEXIST) return output_failed(path_, "exists already and may not be overwritten");
        if (errno != EINVAL && errno != ENOSYS) {
            error_ = errno;
            return error();
        }
    }
    if (::rename(from, to) != 0) {
        error_ = errno;
        return error();
    }
    return Done{};
}

Status check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    const bool is_picture = std::any_of(outputs.begin(), outputs.end(),
                                        [](const std::string& path) { return path.starts_with("-."); });
    if (is_picture && std::count_if(outputs.begin(), outputs.end(), is_standard_output) > 1)
        return Error{ErrorCode::InvalidArgument,
                     "two outputs cannot both go to standard output; give one of them a file"};
    std::unordered_set<std::string> read;
    for (const std::string& input : inputs)
        if (is_file_name(input) && ::access(input.c_str(), F_OK) == 0) read.insert(identity(input));
    std::unordered_map<std::string, std::string> written;  // by identity, as it is called
    for (const std::string& path : outputs) {
        if (!is_file_name(path)) continue;
        if (Status fine = check_target(path); !fine) return fine;
        const std::string which = identity(path);
        if (read.contains(which))
            return Error{ErrorCode::InvalidArgument,
                         "the output " + path + " would replace the input; give another name"};
        if (const auto [other, is_new] = written.emplace(which, path); !is_new)
            return Error{ErrorCode::InvalidArgument, "the output " + path + " would replace the output " +
                                                         other->second + "; give another name"};
    }
    return Done{};
}

Status write_text(const std::string& path, const std::string& text, bool overwrite) {
    const auto file = OutputFile::create(path, overwrite);
    if (!file) return file.error();
    (*file)->write_at(0, text.data(), text.size());
    return (*file)->commit();
}

Status make_folder(const std::string& folder) {
    std::error_code problem, missing;
    std::filesystem::create_directories(folder, problem);
    if (std::filesystem::is_directory(folder, missing)) return Done{};
    return Error{ErrorCode::OutputFailed,
                 "cannot make the folder " + folder + ": " +
                     (problem ? problem.message() : std::string("there is a file of that name"))};
}

}  // namespace petzval
