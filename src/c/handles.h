// What the C door's files share: handles, and how a call ends.
#pragma once

#include "petzval/look.h"
#include "petzval/petzval_c.h"
#include "petzval/result.h"

#include <exception>
#include <new>
#include <string>

struct petzval_look {
    petzval::Look look;
    mutable std::string json;
};

namespace petzval::c {

// Notes it for this thread's petzval_error_text().
petzval_status fail(petzval_status status, std::string text);
petzval_status fail(const Error& error);
petzval_status missing(const char* argument);
// A look names its pictures by file, and files are not the core's to read.
Status check_pictures(const Look& look);

// Runs what may throw on behalf of somebody who cannot catch: the one place that catches.
template <typename Body>
petzval_status guarded(const Body& body) noexcept {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return fail(PETZVAL_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& e) {
        return fail(PETZVAL_INTERNAL, std::string("a fault of petzval: ") + e.what());
    } catch (...) {
        return fail(PETZVAL_INTERNAL, "a fault of petzval");
    }
}

}  // namespace petzval::c
