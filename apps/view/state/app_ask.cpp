// Requests for missing work: frames from the maker, prints from the darkroom, the lens from the bench.
#include "app.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::view {
namespace {

// Targets of the darkroom: of each side all of it and its detail, then the overlay.
int whole_target(int side) { return 2 * side; }
int detail_target(int side) { return 2 * side + 1; }
constexpr int kOverlayTarget = 4;

double area(const Rect& r) { return r.empty() ? 0 : double(r.width()) * double(r.height()); }
bool holds(const Rect& outer, const Rect& inner) { return inner.intersected(outer) == inner; }

}  // namespace

void App::ask() {
    play();
    refine_scene();
    if (!(state.choice.input == opened_)) read_again();
    if (!shot_) return;
    ask_frame(0, state.left);
    ask_prints(0, state.left);
    if (state.wiping) {
        ask_frame(1, state.right);
        ask_prints(1, state.right);
    } else if (sides_[1].wish) {
        maker_.forget(1);
        sides_[1] = {};
    }
    if (state.lens) ask_lens();
    const std::string& shown = state.left.shown;
    const bool is_light = shown == "result" || shown == "sharp" || shown == "against";
    if (!state.overlay || !is_light || !sides_[0].radii) return clear_print(kOverlayTarget);
    Negative tint;
    tint.plane = sides_[0].radii;
    tint.area = shot_->shot.place.data_window;
    tint.numbers = Numbers::Overlay;
    ask_print(kOverlayTarget, std::move(tint));
}

// The visible region, if it is much smaller than the frame.
std::optional<Rect> App::region_for(const SideFrames& frames, const Wish& wish) const {
    const Rect data = shot_->shot.place.data_window;
    const Rect seen = mapping.seen().intersected(data);
    if (wish.shown != "result" || seen.empty() || area(seen) > 0.5 * area(data)) return std::nullopt;
    if (frames.wish && same_frame(*frames.wish, wish) && frames.wish->final_quality == wish.final_quality) {
        const auto& before = frames.wish->region;
        if (!before && frames.complete) return before;
        if (before && holds(*before, seen) && area(*before) < 6 * area(seen)) return before;
    }
    return seen.grown(std::max(seen.width(), seen.height()) / 4).intersected(data);
}

void App::ask_frame(int index, const Side& side) {
    SideFrames& frames = sides_[std::size_t(index)];
    if (!is_made(side.shown) && index == 1) return;
    if (shot_->shot.depth_plane().empty()) return;  // the sharp picture is shown
    const auto numbers = camera();
    if (!numbers) {
        trouble = numbers.error().message;
        return;
    }
    Wish wish{shot_, *numbers,           state.choice.look, is_made(side.shown) ? side.shown : "coc",
              {},    state.final_quality};
    if (!side.engine.empty()) wish.look.engine = side.engine;
    wish.on_cpu = side.on_cpu;
    wish.region = region_for(frames, wish);
    if (state.channel == Channel::Colour && !state.choice.ocio && wish.shown == "result" && !wish.region)
        wish.codes = state.choice.develop;
    if (!is_live()) wish.coarse = coarse_by();
    const bool same = frames.wish && same_frame(*frames.wish, wish);
    if (same && frames.wish->region == wish.region && frames.wish->final_quality == wish.final_quality)
        return;
    if (!same) frames.whole_is_old = frames.detail_is_old = true;
    if (frames.wish && frames.wish->shown != wish.shown)
        frames.whole.reset(), frames.detail.reset(), frames.codes.reset();
    if (!same && index == 0 && !changed_) changed_ = acted_;
    frames.complete = false;
    frames.wish = wish;
    frames.number = maker_.make(index, std::move(wish));
}

void App::ask_prints(int index, const Side& side) {
    const SideFrames& frames = sides_[std::size_t(index)];
    Negative whole;
    whole.area = shot_->shot.place.data_window;
    const auto borrowed = [](const ShotPointer& owner, const auto& picture) {
        using Image = std::remove_reference_t<decltype(picture)>;
        return std::shared_ptr<Image>(owner, &picture);
    };
    if (side.shown == "coc") {
        whole.plane = sides_[0].radii, whole.numbers = Numbers::Radii;
    } else if (side.shown == "depth") {
        if (const auto* depth = std::get_if<DepthMetres>(&shot_->shot.depth))
            whole.plane = borrowed(shot_, depth->plane), whole.numbers = Numbers::Depth;
    } else if (side.shown == "against" && against_) {
        whole.picture = borrowed(against_, against_->shot.colour);
        whole.area = against_->shot.place.data_window;
    } else if (side.shown == "hidden" && shot_->hidden) {
        whole.picture = shot_->hidden;
    } else if (side.shown == "holdout" && shot_->holdout) {
        whole.picture = shot_->holdout;
    } else if (side.shown.starts_with(kSharpLayer)) {
        for (const FrameLayer& layer : shot_->shot.layers)
            if (side.shown == kSharpLayer + name_of(layer)) whole.picture = borrowed(shot_, layer.colour);
    } else if (is_made(side.shown) && frames.whole && frames.numbers) {
        whole.plane = frames.numbers, whole.numbers = Numbers::Radii;
    } else if (is_made(side.shown) && frames.whole) {
        whole.picture = frames.whole, whole.area = frames.whole_area, whole.panels = frames.panels;
        whole.reduce = frames.last.coarse;
    } else if (is_made(side.shown) && frames.codes) {
        whole.codes = frames.codes, whole.area = frames.whole_area, whole.reduce = frames.last.coarse;
    } else {
        whole.picture = borrowed(shot_, shot_->shot.colour);
    }
    ask_print(whole_target(index), std::move(whole));
    if (side.shown != "result" || !frames.detail) return clear_print(detail_target(index));
    Negative detail;
    detail.picture = frames.detail, detail.area = frames.detail_area;
    ask_print(detail_target(index), std::move(detail));
}

// Requests the lens at the picked pixel, otherwise in the middle of the frame at the focus distance.
void App::ask_lens() {
    const auto numbers = camera();
    if (!numbers) return;
    const Place& place = shot_->shot.place;
    LensWish wish;
    wish.choice = state.choice.look.lens;
    wish.mount = {*numbers, place.display_window.width(), place.display_window.height(), place.pixel_aspect};
    wish.depth_m = numbers->focus_distance_m;
    if (state.pick) {
        const FieldPosition field =
            Place::whole({0, 0, wish.mount.width_px, wish.mount.height_px}, place.pixel_aspect)
                .field()
                .field_at(state.pick->x, state.pick->y);
        if (std::hypot(field.x, field.y) <= 1) wish.field_x = field.x, wish.field_y = field.y;
        wish.depth_m = depth_near(*state.pick).value_or(INFINITY);
    }
    if (lens_wish_ && *lens_wish_ == wish) return;
    lens_wish_ = wish;
    bench_.make(std::move(wish));
}

Status App::open_sheet(std::vector<SheetEntry> entries) {
    const auto now = camera();
    if (!now) return now.error();
    if (!shot_ || shot_->shot.depth_plane().empty())
        return Error{ErrorCode::InvalidArgument, "a sheet of looks needs a picture with depth"};
    sheet_tiles_.clear();
    for (const SheetEntry& entry : entries) {
        sheet_tiles_.push_back(std::make_unique<SheetTile>());
        sheet_tiles_.back()->entry = entry;
    }
    sheet_.make(shot_, *now, std::move(entries), state.choice.develop);
    return Done{};
}

void App::close_sheet() {
    sheet_.stop();
    sheet_tiles_.clear();
}

void App::take_cell(SheetCell cell) {
    if (cell.entry >= sheet_tiles_.size()) return;
    SheetTile& tile = *sheet_tiles_[cell.entry];
    tile.error = std::move(cell.error);
    if (!cell.rgba.empty()) tile.texture.load(cell.width, cell.height, cell.rgba);
}

void App::take_lens(LensMade made) {
    if (made.error) trouble = made.error->message;
    const LensCodes* codes[] = {&made.disc, &made.front, &made.behind, &made.strip};
    for (std::size_t i = 0; i < LensMade::kPictures; ++i)
        if (!codes[i]->rgba.empty())
            lens_pictures_[i].load(codes[i]->width, codes[i]->height, codes[i]->rgba);
    lens_made_ = std::move(made);
}

// Requests the visible part and a margin, so that panning shows no gaps; at screen resolution.
void App::ask_print(int target, Negative negative) {
    Shown& shown = on_screen_[std::size_t(target)];
    if (!negative.picture && !negative.codes && !negative.plane) return clear_print(target);
    const double scale = std::min(mapping.scale_x, mapping.scale_y);
    if (!(scale > 0)) return;
    const Rect seen = mapping.seen();
    const Rect wanted = seen.intersected(negative.area);
    if (wanted.empty()) return clear_print(target);
    if (!negative.codes) negative.reduce = std::max(negative.reduce, int(std::floor(1 / scale)));
    negative.part =
        negative.codes ? negative.area
                       : seen.grown(std::max(seen.width(), seen.height()) / 4 + 1).intersected(negative.area);
    negative.permissible_radius_px = setup_.run.permissible_radius_px;
    negative.develop = state.choice.develop;
    negative.ocio = state.choice.ocio;
    negative.channel = state.channel;
    if (shown.asked) {  // the part that was asked for will do while it holds what is seen
        const Rect& before = shown.asked->part;
        if (!negative.codes && shown.asked->area == negative.area && shown.asked->reduce == negative.reduce &&
            holds(before, wanted) && area(before) < 6 * area(negative.part))
            negative.part = before;
        if (*shown.asked == negative) return;
    }
    shown.asked = negative;
    darkroom_.print(target, std::move(negative));
}

void App::clear_print(int target) {
    Shown& shown = on_screen_[std::size_t(target)];
    shown.asked.reset();
    shown.print = {};
}

}  // namespace petzval::view
