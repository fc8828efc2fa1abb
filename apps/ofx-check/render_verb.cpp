#include "render_verb.h"

#include "petzval/files.h"
#include "petzval/shot.h"

#include "instances.h"

#include <utility>

namespace ofx_check {
namespace {

// The host's rows run upwards from the bottom of the display window.
ofx::RectI upwards(const petzval::Place& place) {
    const petzval::Rect &data = place.data_window, &display = place.display_window;
    return {data.x0 - display.x0, display.y1 - data.y1, data.x1 - display.x0, display.y1 - data.y0};
}

petzval::Result<Picture> read_clip(const std::string& text) {
    const petzval::FileChannel from = petzval::file_channel(text);
    petzval::ReadOptions options;
    options.need_depth = options.need_colour = false;
    options.depth_channel = from.channel;
    const auto frame = petzval::read_frame(from.file, options);
    if (!frame) return frame.error();
    Picture picture(upwards(frame->place), 4);
    const int height = picture.height();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const petzval::Rgba colour = frame->colour.empty() ? petzval::Rgba{} : frame->colour(x, y);
            const float depth = from.channel.empty() || frame->depth.empty() ? 0 : frame->depth(x, y);
            const float values[4] = {colour.r, colour.g, colour.b, colour.a};
            for (int c = 0; c < 4; ++c)
                picture.at(picture.bounds.x1 + x, picture.bounds.y2 - 1 - y, c) =
                    from.channel.empty() ? values[c] : depth;
        }
    return picture;
}

std::string write(const Picture& picture, const std::string& path) {
    petzval::Frame frame;
    frame.colour = petzval::Picture(picture.width(), picture.height());
    frame.place = petzval::Place::whole(frame.colour.rect());
    frame.has_alpha = true;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const auto value = [&](int c) {
                return picture.at(picture.bounds.x1 + x, picture.bounds.y2 - 1 - y, c);
            };
            frame.colour(x, y) = {value(0), value(1), value(2), value(3)};
        }
    petzval::WriteOptions options;
    options.type = petzval::PixelType::Float;
    const auto written = petzval::write_exr(path, frame, options);
    return written ? "" : written.error().message;
}

std::string context_of(const std::string& word) {
    if (word == "general") return ofx::kContextGeneral;
    return word == "filter" ? ofx::kContextFilter : word;
}

// Empty if the plug-in has each clip that has a file.
std::string missing_clip(const ofx::Effect& effect, const RenderJob& job) {
    std::string known;
    for (const auto& clip : effect.clips) known += (known.empty() ? "" : ", ") + clip->name;
    for (const auto& [name, file] : job.clips)
        if (!effect.find(name)) return "the plug-in has no clip " + (name + "; it has ").append(known);
    return "";
}

std::string no_parameter(const std::string& name, const std::string& value) {
    return "the plug-in has no parameter " + name + " that takes '" + value + "'";
}

// Clips of one channel have no alpha.
void unpremultiply(ofx::Effect& effect, const RenderJob& job) {
    for (const auto& clip : effect.clips) {
        const auto from = job.clips.find(clip->name);
        if (from != job.clips.end() && !petzval::file_channel(from->second).channel.empty()) continue;
        clip->properties.with(ofx::kPreMultiplication, std::vector<std::string>{ofx::kUnPreMultiplied});
        std::vector<float>& values = clip->picture.values;
        for (std::size_t i = 0; clip->picture.channels == 4 && i < values.size(); ++i)
            if (i % 4 != 3 && values[i | 3] > 0) values[i] /= values[i | 3];
    }
}

void premultiply(Picture& picture) {
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        if (i % 4 != 3) picture.values[i] *= picture.values[i | 3];
}

// Sets the values that the project has, then those that the user gives, each with its actions.
std::string set_all(Stage& stage, ofx::Effect& effect, const Setup& setup, const RenderJob& job,
                    const FrameRequest& request) {
    for (const auto& [name, value] : setup.params)
        if (!set_param(effect, name, value)) return no_parameter(name, value);
    for (const auto& [name, value] : job.edits) {
        if (!set_param(effect, name, value)) return no_parameter(name, value);
        const int status = stage.tell_change(effect, name, request);
        if (status == ofx::kOk || status == ofx::kReplyDefault) continue;
        return "the plug-in answers the change of " + name + " with status " + std::to_string(status);
    }
    return "";
}

}  // namespace

std::string render_picture(const Setup& setup, const RenderJob& job) {
    if (job.output.empty() || !job.clips.contains(ofx::kSource))
        return "render needs -o OUT.exr and --clip Source=FILE";
    Cast cast{context_of(job.context)};
    for (const auto& [clip, file] : job.clips) {
        auto picture = read_clip(file);
        if (!picture) return clip + ": " + picture.error().message;
        cast.pictures[clip] = std::move(*picture);
    }
    Stage stage(setup);
    if (!stage.begin()) return stage.problem();
    auto effect = stage.create(cast);
    if (!effect) return stage.problem();
    if (std::string missing = missing_clip(*effect, job); !missing.empty()) return missing;
    if (job.is_unpremultiplied) unpremultiply(*effect, job);
    FrameRequest request;
    request.time = job.time;
    request.scale = {job.scale, job.scale};
    const std::string not_set = set_all(stage, *effect, setup, job, request);
    if (!not_set.empty()) return not_set;
    Rendered rendered = stage.render(*effect, request);
    if (job.is_unpremultiplied) premultiply(rendered.picture);
    std::string problem;
    if (rendered.fine() && !counts.last_message.empty())
        std::fprintf(stderr, "the plug-in says: %s\n", counts.last_message.c_str());
    if (!rendered.fine())
        problem = "status " + std::to_string(rendered.status) + ": " +
                  (counts.last_message.empty() ? "no message" : counts.last_message);
    stage.destroy(std::move(effect));
    return problem.empty() ? write(rendered.picture, job.output) : problem;
}

}  // namespace ofx_check
