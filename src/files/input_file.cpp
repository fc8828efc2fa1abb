#include "files/input_file.h"

#include "files/wording.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace petzval {

InputFile::InputFile(std::string path, int descriptor, std::uint64_t bytes)
    : path_(std::move(path)), descriptor_(descriptor), bytes_(bytes) {}

InputFile::~InputFile() { ::close(descriptor_); }

Result<std::shared_ptr<const InputFile>> InputFile::open(const std::string& path) {
    // O_NONBLOCK: opening a pipe nobody writes to would wait for ever.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return invalid_file(path, "cannot be opened: " + std::string(std::strerror(errno)));
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

bool InputFile::read_at(std::uint64_t offset, void* to, std::size_t bytes) const {
    if (offset > bytes_ || bytes > bytes_ - offset) return false;
    char* out = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got = ::pread(descriptor_, out, bytes, off_t(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        out += got, offset += std::uint64_t(got), bytes -= std::size_t(got);
    }
    return true;
}

}  // namespace petzval
