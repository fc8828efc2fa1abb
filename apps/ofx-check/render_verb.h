// A picture rendered by a plug-in, from EXR files to an EXR file.
#pragma once

#include "stage.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ofx_check {

struct RenderJob {
    std::map<std::string, std::string> clips;                // FILE or FILE:CHANNEL by clip
    std::vector<std::pair<std::string, std::string>> edits;  // value by parameter, in the order of the user
    std::string output, context;
    double time = 1, scale = 1;
    bool is_unpremultiplied = false;  // the host keeps all clips so, Output as well; files are premultiplied
};

// Returns what went wrong; empty if the picture was written.
std::string render_picture(const Setup& setup, const RenderJob& job);

}  // namespace ofx_check
