// A frame that a session is asked for: what was rendered, what is chosen, what is lent to it.
#pragma once

#include "petzval/defocus.h"
#include "petzval/lens.h"
#include "petzval/look.h"
#include "petzval/rendered.h"
#include "petzval/result.h"
#include "petzval/session.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

struct FrameRequest {
    Rendered rendered;
    Look look;                      // its lens is the choice of `lens`, once that is open
    std::optional<Lens> lens = {};  // none: not opened yet
    ScatterView view = ScatterView::Result;
    Workers* workers = nullptr;        // those of the frame; never null
    std::size_t max_memory_bytes = 0;  // less what others hold
    std::string kernel_cache_folder = {};
    std::size_t kernel_cache_bytes = 0;
};

// True if the frame is a matte of guesses (ScatterView::Guessed): a value of surfaces, not light.
inline bool is_matte(const FrameRequest& request) { return request.view == ScatterView::Guessed; }

inline Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// The choices of a job.
Look look_of(const DefocusJob& job);
// A line for each field of a look that is light, and no part of a blur alone.
std::vector<std::string> left_out_of_blur(const Look& look);
// A line for each field of a job that was given and is not used: a look replaces the choices of the job,
// and a session's settings replace its own.
std::vector<std::string> not_used_of(const DefocusJob& job, const Look& look);
std::vector<std::string> not_used_of(const DefocusJob& job, const SessionSettings& settings,
                                     const Control& control);
// Its control of how the frame is made, beside what `control` says.
Control control_of(const DefocusJob& job, const Control& control);

// Lent by a session. held_bytes: of its memory, what the caller holds beside.
FrameRequest request_of(Rendered rendered, const Look& look, const Control& control,
                        const SessionSettings& settings, Workers& workers);

}  // namespace petzval
