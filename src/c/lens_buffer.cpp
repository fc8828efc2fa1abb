// The lens of the real-time pass behind the C door, for hosts that run the programs of the shader kit.
#include "petzval/names.h"
#include "petzval/petzval_c.h"
#include "petzval/session.h"

#include "c/handles.h"
#include "c/lens_handle.h"
#include "c/lens_mount.h"

#include <cstring>
#include <string>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

// The arguments that both functions have.
struct Asked {
    LensMount mount;
    Quality quality = Quality::Standard;
};

Result<Asked> asked_of(const petzval_lens& lens, const petzval_lens_mount* given, const char* quality) {
    const auto mount = c::mount_of(given, lens.lens);
    if (!mount) return mount.error();
    if (mount->pixel_aspect != 1)
        return Error{ErrorCode::InvalidArgument, "mount.pixel_aspect must be 1 for a lens buffer"};
    Asked asked{*mount};
    if (!quality) return asked;
    const auto named = parse<Quality>(quality);
    if (!named) return Error{ErrorCode::InvalidArgument, "quality is " + named.error().message};
    asked.quality = *named;
    return asked;
}

Result<std::size_t> bytes_of(const petzval_lens& lens, const Asked& asked) {
    const LensMount& on = asked.mount;
    return realtime_lens_buffer_bytes(lens.lens, on.camera, on.width_px, on.height_px, asked.quality);
}

petzval_status write_buffer(const petzval_lens& lens, const Asked& asked, void* buffer, size_t byte_count) {
    const auto needed = bytes_of(lens, asked);
    if (!needed) return fail(needed.error());
    if (byte_count < *needed)
        return fail(PETZVAL_INVALID_ARGUMENT, "byte_count is " + std::to_string(byte_count) +
                                                  "; this buffer needs " + std::to_string(*needed));
    const LensMount& on = asked.mount;
    const auto made = realtime_lens_buffer(lens.lens, on.camera, on.width_px, on.height_px, asked.quality);
    if (!made) return fail(made.error());
    std::memcpy(buffer, made->values.data(), *needed);
    return PETZVAL_OK;
}

}  // namespace

petzval_status petzval_lens_buffer_bytes(const petzval_lens* lens, const petzval_lens_mount* mount,
                                         const char* quality, size_t* bytes) {
    if (!lens) return missing("lens");
    if (!bytes) return missing("bytes");
    return guarded([&] {
        const auto asked = asked_of(*lens, mount, quality);
        if (!asked) return fail(asked.error());
        const auto needed = bytes_of(*lens, *asked);
        if (!needed) return fail(needed.error());
        *bytes = *needed;
        return PETZVAL_OK;
    });
}

petzval_status petzval_lens_buffer(const petzval_lens* lens, const petzval_lens_mount* mount,
                                   const char* quality, void* buffer, size_t byte_count) {
    if (!lens) return missing("lens");
    if (!buffer) return missing("buffer");
    return guarded([&] {
        const auto asked = asked_of(*lens, mount, quality);
        return asked ? write_buffer(*lens, *asked, buffer, byte_count) : fail(asked.error());
    });
}

petzval_status petzval_check_lens_buffer(const void* buffer, size_t byte_count) {
    if (!buffer) return missing("buffer");
    return guarded([&] {
        const Status done = check_lens_buffer({static_cast<const std::byte*>(buffer), byte_count});
        return done ? PETZVAL_OK : fail(done.error());
    });
}
