// Errors as values: a function that can fail on its input returns Result<T>.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace petzval {

// Kind of failure; the command line turns it into an exit code.
enum class ErrorCode {
    InvalidArgument,  // a flag, a camera number or a field of a struct is wrong or missing
    InvalidFile,      // an input is missing, damaged, empty or lacks what is needed (depth)
    Unsupported,      // understood, but this build or engine cannot do it
    OutputFailed,     // an output could not be written: path, rights, disk
    OutOfMemory,      // the work does not fit the memory limit
    Cancelled,        // the progress callback asked to stop
    ReadFailed,       // the system failed to read an input; another try may succeed
};

// One sentence: the problem, its place, and the accepted values. No trailing newline. Settings are named by
// their field, such as camera.f_number (for a look, see petzval/look_json.h); a program may substitute its
// own names.
struct Error {
    ErrorCode code = ErrorCode::InvalidArgument;
    std::string message;
    std::string field = {};  // the wrong setting, if there is one
};

// A value or an Error.
template <typename T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    // Requires: has_value(). Otherwise std::bad_variant_access is thrown: a bug of the caller.
    const T& value() const& { return std::get<0>(state_); }
    T& value() & { return std::get<0>(state_); }
    T&& value() && { return std::get<0>(std::move(state_)); }
    const T& operator*() const& { return value(); }
    T& operator*() & { return value(); }
    const T* operator->() const { return &value(); }
    T* operator->() { return &value(); }

    // Requires: !has_value().
    const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<T, Error> state_;
};

// Success without a value.
struct Done {};
using Status = Result<Done>;

}  // namespace petzval
