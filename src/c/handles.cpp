#include "c/handles.h"

#include "petzval/version.h"

#include <cstring>
#include <iterator>
#include <utility>

namespace petzval::c {
namespace {

// The sentence of the last failure of this thread.
std::string& error_text() {
    thread_local std::string text;
    return text;
}

petzval_status status_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::InvalidArgument:
            return PETZVAL_INVALID_ARGUMENT;
        case ErrorCode::InvalidFile:
            return PETZVAL_INVALID_FILE;
        case ErrorCode::Unsupported:
            return PETZVAL_UNSUPPORTED;
        case ErrorCode::OutputFailed:
            return PETZVAL_OUTPUT_FAILED;
        case ErrorCode::OutOfMemory:
            return PETZVAL_OUT_OF_MEMORY;
        case ErrorCode::Cancelled:
            return PETZVAL_CANCELLED;
        case ErrorCode::ReadFailed:
            return PETZVAL_READ_FAILED;
    }
    return PETZVAL_INTERNAL;
}

}  // namespace

// A message names what a host gave, which may be of any length.
petzval_status fail(petzval_status status, std::string text) {
    constexpr std::size_t kLongest = 1000;
    if (text.size() > kLongest) {
        std::size_t end = kLongest;
        const auto is_inside_letter = [&] { return (unsigned(text[end]) & 0xC0u) == 0x80u; };
        while (end > 0 && is_inside_letter()) --end;
        text.resize(end);
        text += "…";
    }
    error_text() = std::move(text);
    return status;
}

petzval_status fail(const Error& error) { return fail(status_of(error.code), error.message); }

petzval_status missing(const char* argument) {
    return fail(PETZVAL_INVALID_ARGUMENT, std::string(argument) + " is null");
}

Status check_pictures(const Look& look) {
    for (const auto& [field, file] : {std::pair("lens.aperture_image", &look.aperture_image),
                                      std::pair("lens.kernel_image", &look.kernel_image_far)})
        if (!file->empty())
            return Error{ErrorCode::Unsupported,
                         std::string(field) + " names a file, which this library does not read: " + *file};
    return Done{};
}

Result<Lens> lens_of(const petzval_look& look) {
    return look.lens ? look.lens->with(look.look.lens) : Lens::open(look.look.lens);
}

}  // namespace petzval::c

const char* petzval_error_text(void) { return petzval::c::error_text().c_str(); }

const char* petzval_status_name(petzval_status status) {
    static const char* const names[] = {"ok",          "invalid_argument", "invalid_file",
                                        "unsupported", "output_failed",    "out_of_memory",
                                        "cancelled",   "internal"};
    // A C program may pass any number; in C++ an enumeration that holds one of no enumerator must not be
    // read.
    unsigned index = 0;
    static_assert(sizeof(index) == sizeof(status));
    std::memcpy(&index, &status, sizeof(index));
    return index < std::size(names) ? names[index] : "unknown";
}

const char* petzval_version(void) { return PETZVAL_VERSION; }
