// Someone else's program: built against what was installed, never against this repository.
#include <cmath>
#include <cstdio>
#include <petzval/petzval.h>
#include <string>

int main() {
    // 50 mm f/2 focused at 2 m on 36 mm, 64 px: D f W / 2 s = 25 * 50 * 64 / 72 = 1111.1 px mm,
    // / 2000 mm = 0.556 px behind everything.
    const petzval::Camera camera{
        .focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 2};
    const auto coc = petzval::CircleOfConfusion::make(camera, 64);
    if (!coc || std::abs(coc->radius_at_infinity_px() - 25.0 * 50 * 64 / 72 / 2000) > 1e-9) return 1;

    petzval::Picture colour(64, 32, {0.5f, 0.25f, 0.125f, 1});
    const petzval::Plane depth(64, 32, 0.2f);
    colour(20, 16).r = 100;
    petzval::DefocusJob job;
    job.colour = colour;
    job.depth_m = depth;
    job.place = petzval::Place::whole(colour.rect());
    job.camera = camera;
    for (const std::string& engine : petzval::engine_names()) {
        if (engine == "realtime") continue;  // of GPUs alone
        job.engine = engine;
        const auto report = petzval::defocus(job);
        if (!report) return std::fprintf(stderr, "%s\n", report.error().message.c_str()), 1;
        const float peak = report->image(20, 16).r;
        std::printf("petzval %s, %s: coc %.3f px, peak %.2f of 100\n", PETZVAL_VERSION, engine.c_str(),
                    coc->radius_px(0.2), peak);
        if (!(peak > 0.5f && peak < 20)) return 1;  // a point 5 px out of focus spreads over some 80 pixels
    }
    return petzval::engine_names().empty() ? 1 : 0;
}
