#include "engine/engine.h"
namespace petzval::engine {
Result<Output> run_scatter(const Input& input) { return run_reference(input); }
}  // namespace petzval::engine
