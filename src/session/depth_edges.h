// Soft silhouettes of a job's depth, made hard.
#pragma once

#include "petzval/defocus.h"

#include <string>

namespace petzval {

// Where job.depth_edges asks for it, points the job to depth, or radii, without ramps; these live here.
class HardEdges {
public:
    // Requires: check_job(job).
    HardEdges(DefocusJob& job, Workers& workers);
    HardEdges(const HardEdges&) = delete;
    HardEdges& operator=(const HardEdges&) = delete;
    const std::string& what_was_done() const { return what_was_done_; }  // empty: nothing

private:
    Plane plane_;
    std::string what_was_done_;
};

}  // namespace petzval
