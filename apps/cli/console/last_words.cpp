#include "console/last_words.h"

#include "petzval/output.h"

#include <exception>
#include <new>
#include <string_view>
#include <unistd.h>

namespace petzval::cli {
namespace {

void say(std::string_view line) noexcept {
    if (::write(STDERR_FILENO, line.data(), line.size()) < 0) return;  // nobody reads it
}

[[noreturn]] void end() noexcept {
    bool is_memory = false;
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        is_memory = true;
    } catch (...) {
        is_memory = false;
    }
    remove_unfinished_outputs();
    if (is_memory)
        say_out_of_memory();
    else
        say("petzval: a library ended the program; memory or threads may have run out\n");
    ::_exit(1);
}

}  // namespace

void say_out_of_memory() noexcept {
    say("petzval: not enough memory; --max-memory or a smaller picture needs less\n");
}

void end_orderly_on_terminate() noexcept { std::set_terminate(end); }

namespace {

// Tables of names are made before main(), and memory can end there as well.
[[gnu::constructor(101)]] void before_all_tables() { end_orderly_on_terminate(); }

}  // namespace

}  // namespace petzval::cli
