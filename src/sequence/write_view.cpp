#include "sequence/write_view.h"

#include "petzval/reports/words.h"
#include "petzval/views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::sequence {
namespace {

bool is_exr(const ViewSettings& settings) { return *kind_of_output(settings.output) == FileKind::Exr; }

WriteOptions exr_options(const ViewSettings& settings) {
    WriteOptions options;
    options.overwrite = settings.overwrite;
    options.attributes = settings.attributes;
    options.threads = settings.develop.threads;
    return options;
}

// An EXR keeps the window of the input; a PNG knows only the display window.
const Rect& window_of(const Frame& frame, const ViewSettings& settings) {
    return is_exr(settings) ? frame.place.data_window : frame.place.display_window;
}

template <typename T>
Image<T> in_output_window(const Image<T>& pixels, const Frame& frame, const ViewSettings& settings, T fill) {
    return through_window(pixels, frame.place.data_window, window_of(frame, settings), fill);
}

Status write_plane(const std::string& channel, View<const float> plane, const Frame& frame,
                   const ViewSettings& settings, WriteOptions options) {
    options.type = PixelType::Float;
    return write_exr_planes(settings.output, frame.place, {{channel, plane}}, options);
}

// "FOCUS 4 M  85 MM F/4"
std::string legend_title(const FoundCamera& camera) {
    std::string title = "BLUR";
    if (camera.focus_distance_m) title = "FOCUS " + plain(camera.focus_distance_m->value, 4) + " M";
    if (camera.focal_length_mm) title += "  " + plain(camera.focal_length_mm->value, 4) + " MM";
    if (camera.f_number) title += " F/" + plain(camera.f_number->value, 3);
    return title;
}

// A picture meant for displays: as PNG it goes out as it is, as EXR its light is display-linear.
Status write_display_picture(Picture picture, Frame& frame, const ViewSettings& settings) {
    if (!is_exr(settings)) {
        DevelopSettings as_it_is = settings.develop;
        as_it_is.tone = ToneCurve::None;
        as_it_is.exposure_stops = 0;
        return write_developed(settings.output, picture.view(), as_it_is, settings.overwrite,
                               frame.place.pixel_aspect, settings.png_texts);
    }
    Frame drawn;
    drawn.place = frame.place;
    drawn.colour = std::move(picture);
    return write_exr(settings.output, drawn, exr_options(settings));
}

Status write_beauty(Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    if (!is_exr(settings) && !source.codes.empty()) {
        const Rect& window = window_of(frame, settings);
        return write_codes(settings.output, window.width(), window.height(), source.codes,
                           settings.develop.bits, settings.overwrite, frame.place.pixel_aspect,
                           settings.png_texts);
    }
    if (!is_exr(settings)) {
        Picture light = in_output_window(frame.colour, frame, settings, Rgba{});
        DevelopSettings develop = settings.develop;
        if (settings.to_display) {
            std::string used;
            Status done = settings.to_display(light, develop, used, *settings.warnings);
            if (!done) return done;
            settings.note(used);
        }
        return write_developed(settings.output, light.view(), develop, settings.overwrite,
                               frame.place.pixel_aspect, settings.png_texts);
    }
    WriteReport changed;
    WriteOptions options = exr_options(settings);
    options.camera = settings.camera;
    options.report = &changed;
    std::vector<const Frame*> frames{&frame};
    frames.insert(frames.end(), settings.other_views.begin(), settings.other_views.end());
    Status done = frames.size() > 1 ? write_exr_views(settings.output, frames, options)
                                    : write_exr(settings.output, frame, options);
    if (changed.became_rgb) settings.note("luminance of the input is written as R, G and B");
    if (changed.clamped_to_half > 0)
        settings.warnings->push_back(std::to_string(changed.clamped_to_half) +
                                     " colour values are too large for half float and were written as 65504");
    return done;
}

Status write_coc(Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    if (!is_exr(settings))
        return write_display_picture(
            coc_map(in_output_window(source.coc_radius_px, frame, settings, 0.0f).view(),
                    legend_title(settings.camera)),
            frame, settings);
    WriteOptions options = exr_options(settings);
    options.attributes.emplace_back("petzval:coc", "signed radius, px, + is far");
    options.camera = settings.camera;
    return write_plane("coc_radius_px", source.coc_radius_px.view(), frame, settings, options);
}

Status write_focus(Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    const Picture sharp = in_output_window(frame.colour, frame, settings, Rgba{});
    const Picture display = shown(sharp, settings.develop);
    Plane radii =
        in_output_window(source.coc_radius_px, frame, settings, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < radii.size(); ++i)  // emptiness is neither sharp nor blurred
        if (sharp.pixels()[i] == Rgba{}) radii.pixels()[i] = std::numeric_limits<float>::quiet_NaN();
    return write_display_picture(
        focus_overlay(display.view(), radii.view(), float(settings.permissible_radius_px),
                      legend_title(settings.camera)),
        frame, settings);
}

// Several pictures in one, larger than the input: as PNG each with its name; as EXR the layers of a picture
// of the input's size where they can be, else light alone.
Status write_panels(Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    const Picture atlas = std::move(frame.colour);
    if (!is_exr(settings))
        return write_display_picture(drawn_panels(atlas, source.panels, settings.develop), frame, settings);
    WriteOptions options = exr_options(settings);
    if (const std::vector<PanelPlane> planes = planes_of(atlas, source.panels); !planes.empty()) {
        std::vector<NamedPlane> named;
        for (const PanelPlane& p : planes) named.push_back({p.channel, p.values.view()});
        options.type = PixelType::Float;
        return write_exr_planes(settings.output, frame.place, named, options);
    }
    options.attributes.emplace_back("petzval:panels", places_of(source.panels));
    Frame alone;
    alone.place = Place::whole(atlas.rect(), frame.place.pixel_aspect);
    alone.has_alpha = true;
    alone.colour = atlas.clone();
    return write_exr(settings.output, alone, options);
}

// Writes nearest/z in a PNG: infinity is 0, and the file can be read back as inverse depth.
Status write_depth(Frame& frame, const ViewSettings& settings) {
    if (is_exr(settings)) {
        WriteOptions options = exr_options(settings);
        options.camera = settings.camera;
        return write_plane("Z", frame.depth.view(), frame, settings, options);
    }
    const float nearest = settings.depth.nearest_m;
    Plane inverse = in_output_window(frame.depth, frame, settings, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < inverse.size(); ++i) inverse.pixels()[i] = nearest / inverse.pixels()[i];
    settings.note("code 65535 is " + plain(nearest) + " m, 0 is infinity; read it with read.depth_file " +
                  settings.output + " depth.kind inverse depth.unit_scale_m " + plain(nearest));
    return write_grey_png(settings.output, inverse.view(), settings.overwrite, settings.png_texts);
}

// One number per pixel that an engine put into every channel.
Status write_number(const std::string& channel, Frame& frame, const ViewSettings& settings) {
    const Plane number = red_of(frame.colour);
    if (is_exr(settings)) return write_plane(channel, number.view(), frame, settings, exr_options(settings));
    return write_grey_png(settings.output, in_output_window(number, frame, settings, 0.0f).view(),
                          settings.overwrite, settings.png_texts);
}

Status write_alpha(Frame& frame, const ViewSettings& settings) {
    Plane alpha(frame.colour.width(), frame.colour.height());
    for (std::size_t i = 0; i < alpha.size(); ++i) alpha.pixels()[i] = frame.colour.pixels()[i].a;
    if (is_exr(settings)) return write_plane("A", alpha.view(), frame, settings, exr_options(settings));
    return write_grey_png(settings.output, in_output_window(alpha, frame, settings, 0.0f).view(),
                          settings.overwrite, settings.png_texts);
}

// A deep EXR that --plate reads.
Status write_hidden(const Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    WriteOptions options = exr_options(settings);
    options.camera = settings.camera;
    settings.note(std::to_string(source.hidden.sample_count()) + " samples; shot.behind " + settings.output +
                  " reads them as a clean plate");
    return write_deep_exr(settings.output, frame.place, source.hidden, options);
}

}  // namespace

Plane red_of(const Picture& picture) {
    Plane red(picture.width(), picture.height());
    for (std::size_t i = 0; i < red.size(); ++i) red.pixels()[i] = picture.pixels()[i].r;
    return red;
}

bool shows_radii(const Look& look) {
    return look.engine == "gather" && look.gather.stage == GatherStage::Coc;
}

Status write_view(ShotView view, Frame& frame, const ViewSource& source, const ViewSettings& settings) {
    switch (view) {
        case ShotView::Coc:
            return write_coc(frame, source, settings);
        case ShotView::Focus:
            return write_focus(frame, source, settings);
        case ShotView::Depth:
            return write_depth(frame, settings);
        case ShotView::Alpha:
            return write_alpha(frame, settings);
        case ShotView::FocusIndex:
            return write_number("focus_index", frame, settings);
        case ShotView::Guessed:
            return write_number("guessed", frame, settings);
        case ShotView::Levels:
        case ShotView::Layers:
        case ShotView::Highlights:
            return write_panels(frame, source, settings);
        case ShotView::Hidden:
            return write_hidden(frame, source, settings);
        default:
            // Radii have a sign, which display codes have not.
            if (!is_exr(settings) && !source.coc_radius_px.empty()) return write_coc(frame, source, settings);
            return write_beauty(frame, source, settings);
    }
}

}  // namespace petzval::sequence
