// Threads that work for the library: our own, or a pool that a host lends.
#pragma once

#include "petzval/export.h"

#include <memory>
#include <type_traits>
#include <utility>

namespace petzval {

// A borrowed function, as cheap as a pointer. The function it refers to must outlive it.
template <typename Signature>
class FunctionRef;

template <typename Returned, typename... Arguments>
class FunctionRef<Returned(Arguments...)> {
public:
    // Not for a FunctionRef itself; the address of a constant function is called as one.
    // NOLINTBEGIN(bugprone-forwarding-reference-overload,cppcoreguidelines-pro-type-const-cast)
    template <typename Function>
    requires(!std::is_same_v<std::remove_cvref_t<Function>, FunctionRef> &&
             std::is_invocable_r_v<Returned, Function&, Arguments...>) FunctionRef(Function&& function)
        : function_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
          call_([](void* f, Arguments... arguments) -> Returned {
              return (*static_cast<std::remove_reference_t<Function>*>(f))(
                  std::forward<Arguments>(arguments)...);
          }) {}
    // NOLINTEND(bugprone-forwarding-reference-overload,cppcoreguidelines-pro-type-const-cast)
    Returned operator()(Arguments... arguments) const {
        return call_(function_, std::forward<Arguments>(arguments)...);
    }

private:
    void* function_;
    Returned (*call_)(void*, Arguments...);
};

// Interface for a host that lends its threads. Results depend neither on the width nor on the thread that
// runs a body.
class PETZVAL_API Workers {
public:
    Workers() = default;
    virtual ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // Number of bodies of one run() that may run at the same time, the calling thread included. At least 1;
    // constant for the object's lifetime.
    virtual int width() const = 0;
    // Calls body(i) once for each i in 0…count-1, on any threads, in any order, and returns when all have
    // returned. Bodies throw nothing, do not wait for other bodies, and never call run(). Several threads
    // may call run() at once if several jobs share the workers.
    virtual void run(int count, FunctionRef<void(int)> body) = 0;
};

// Our own threads, including the calling one; 0: all that this process may use. More threads than CPUs are
// useful in tests only. They are started when first needed and end with the object (if the library is built
// with oneTBB, its threads stay until the process ends).
PETZVAL_API std::shared_ptr<Workers> own_workers(int threads = 0);

}  // namespace petzval
