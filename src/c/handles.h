// Handles, and the end of every call: shared by all files of this room.
#pragma once

#include "petzval/lens.h"
#include "petzval/look.h"
#include "petzval/petzval_c.h"
#include "petzval/result.h"

#include <exception>
#include <new>
#include <optional>
#include <string>

struct petzval_look {
    petzval::Look look;
    std::optional<petzval::Lens> lens;  // opened; of the name that look has. None: by name, when it is used
    mutable std::string json;
};

struct petzval_text {
    std::string json;
};

namespace petzval::c {

// Notes it for this thread's petzval_error_text().
petzval_status fail(petzval_status status, std::string text);
petzval_status fail(const Error& error);
petzval_status missing(const char* argument);
// A look names its pictures by file, and files are not the core's to read.
Status check_pictures(const Look& look);
// The lens of a look: the one it was given, used as its fields say; else opened by name.
Result<Lens> lens_of(const petzval_look& look);

// Thrown for a struct without a size: its other members would be ignored without a word.
struct Unsized {};

// Runs what may throw on behalf of somebody who cannot catch: the one place that catches.
template <typename Body>
petzval_status guarded(const Body& body) noexcept {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return fail(PETZVAL_OUT_OF_MEMORY, "out of memory");
    } catch (const Unsized&) {
        return fail(PETZVAL_INVALID_ARGUMENT,
                    "the member size of a struct is 0; set it to sizeof(the struct), and the members that "
                    "you do not use to 0");
    } catch (const std::exception& e) {
        return fail(PETZVAL_INTERNAL, std::string("an internal error: ") + e.what());
    } catch (...) {
        return fail(PETZVAL_INTERNAL, "an internal error");
    }
}

}  // namespace petzval::c
