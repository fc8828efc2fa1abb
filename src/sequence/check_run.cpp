#include "petzval/shot_run.h"

#include <string>

namespace petzval {
namespace {

Error refused(const std::string& field, const std::string& why) {
    return {ErrorCode::InvalidArgument, field + why, field};
}

}  // namespace

Status check(const ShotRunSettings& settings) {
    const std::string &engine = settings.look.engine, view = name_of(settings.view);
    const ShotSource& source = settings.source;
    if (!source.lights.empty() && engine != "sprites")
        return refused("shot.lights", " has no effect without job.engine sprites");
    if (gaussian_view(settings.view) && engine != "gaussian")
        return refused("job.view", " " + view + " is a buffer of job.engine gaussian");
    if (scatter_view(settings.view) != ScatterView::Result && engine != "scatter")
        return refused("job.view", " " + view + " shows what job.engine scatter does, not " + engine);
    const bool is_beauty = settings.view == ShotView::Beauty;
    const bool computes = is_beauty || settings.view == ShotView::Alpha;
    const std::string here = " has no effect on job.view " + view;
    if (!source.holdout.empty() && !computes) return refused("shot.holdout", here);
    if (settings.region && !is_beauty) return refused("shot.region", here);
    if (settings.overscan_px && !computes) return refused("shot.overscan_px", here);
    if (!source.mask.empty() && !computes) return refused("shot.mask", here);
    if (!source.read.layers.empty() && !is_beauty) return refused("read.layers", here);
    return Done{};
}

}  // namespace petzval
