// What is said and done where no memory is left to say it with.
#pragma once

namespace petzval::cli {

// The line on standard error; takes no memory.
void say_out_of_memory() noexcept;

// From here on std::terminate() is an error like others: half-written outputs are removed, a line says why,
// the exit code is 1. It is called where a library throws on a thread of its own, or where memory ends while
// an error is told.
void end_orderly_on_terminate() noexcept;

}  // namespace petzval::cli
