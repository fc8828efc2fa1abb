// Error handling for the case that no memory is left.
#pragma once

namespace petzval::cli {

// The line on standard error; takes no memory.
void say_out_of_memory() noexcept;

// Makes std::terminate() an ordinary error: removes half-written outputs, prints one line, exits with code 1.
// It is called if a library throws on one of its threads, or if memory runs out while an error is reported.
void end_orderly_on_terminate() noexcept;

}  // namespace petzval::cli
