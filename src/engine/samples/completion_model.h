// All numbers by which hidden surfaces are estimated, each with its unit, its range and its reason.
//
// `./dev bench completion --rules` halves and doubles each of them and switches it off, and prints what that
// changes. Sizes of grids stand where they are used: they change the cost alone.
#pragma once

#include "laws/surfaces.h"

#include <limits>
#include <vector>

namespace petzval::engine {

constexpr int kContinuesPx = 110;  // most of continues_px: strips of a frame overlap by more

struct CompletionModel {
#define PETZVAL_NUMBER(name, value, ...) float name = value;
#include "engine/samples/completion_numbers.inc"
#undef PETZVAL_NUMBER
    // Neighbouring pixels that differ by more show two surfaces: in focus, a pixel that shows both is visible
    // as a fringe.
    float between_px() const { return 0.6f * step_px; }
    // Two pixels apart from each other that differ by more show two surfaces.
    float apart_px() const { return 2 * step_px; }
};

// The numbers that the program uses. Only the bench changes them, before it draws anything.
inline CompletionModel completion_model;

struct CompletionNumber {
    const char* name;
    float CompletionModel::*value;
    float least, most;  // range in which the estimate works as described
    float off;          // value that switches the rule off; NaN if the estimate needs the rule
    const char *unit, *reason;
};

inline std::vector<CompletionNumber> completion_numbers() {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN(), kNever = 1e9f;
#define PETZVAL_NUMBER(name, value, ...) {#name, &CompletionModel::name, __VA_ARGS__},
    return {
#include "engine/samples/completion_numbers.inc"
    };
#undef PETZVAL_NUMBER
}

}  // namespace petzval::engine
