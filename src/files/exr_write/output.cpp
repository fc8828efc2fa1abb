#include "files/exr_write/output.h"

#include "files/exr/file.h"
#include "files/exr/stream.h"
#include "files/output_file.h"
#include "files/wording.h"

namespace petzval {

Status write_exr_file(const std::string& path, bool overwrite,
                      const std::function<Status(Imf::OStream&)>& body) {
    Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, overwrite);
    if (!file) return file.error();
    Status written = Done{};
    try {
        ExrOutputStream stream(**file);
        written = body(stream);
    } catch (const Failure& failure) {
        written = failure.error;
    } catch (const std::bad_alloc&) {
        written = Error{ErrorCode::OutOfMemory, printable(path, 4096) + ": no memory to write it"};
    } catch (const std::exception& e) {
        written = output_failed(path, "cannot be written: " + printable(e.what(), 500));
    }
    // A full disk is the cause, whatever OpenEXR made of it.
    if ((*file)->failed()) return (*file)->error();
    if (!written) return written;
    return (*file)->commit();
}

Channel plain_channel(const std::string& name, ChannelType type) {
    Channel c = split_channel_name(name, {});
    c.type = type;
    return c;
}

}  // namespace petzval
