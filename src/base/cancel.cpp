#include "base/cancel.h"

namespace petzval {
namespace {

thread_local const CancellableWorkers* t_works_for = nullptr;

}  // namespace

WorksFor::WorksFor(const CancellableWorkers& workers) : before_(t_works_for) { t_works_for = &workers; }
WorksFor::~WorksFor() { t_works_for = before_; }

void check_cancelled() {
    if (t_works_for) t_works_for->check();
}

}  // namespace petzval
