// Commands of a shot: its frames, and the keys of its focus.
#include "petzval/output.h"
#include "petzval/track.h"

#include "command_list.h"
#include "fields.h"

#include <algorithm>
#include <cmath>

namespace petzval::view {
namespace {

using Words = std::vector<std::string>;

Status no_shot() { return invalid("this is one picture; open a shot by a name with ####"); }

}  // namespace

// The first click of a rack is a key at the first frame that is played, the second one at the last.
Status rack_to(App& app, double focus_m) {
    Timeline& line = app.state.timeline;
    const bool is_first = line.rack_clicks-- == 2;
    if (is_first) line.keys.clear();
    line.keys[is_first ? line.first : line.last] = focus_m;
    app.go_to(is_first ? line.last : line.first);
    app.notice = is_first ? "rack from " + text_of(focus_m, 4) + " m; click the subject in frame " +
                                std::to_string(line.last)
                          : "rack to " + text_of(focus_m, 4) + " m; Space plays it";
    return Done{};
}

// A number, or so many steps on: +1, -1; first, last.
Status frame(App& app, const Words& words) {
    const Timeline& line = app.state.timeline;
    if (!line.is_shot()) return no_shot();
    const auto number = number_of(words[0]);
    const bool steps = words[0].starts_with('+') || words[0] == "-1";
    int wanted = words[0] == "first" ? line.first : line.last;
    if (number)
        wanted = steps ? line.stepped(int(*number)) : int(*number);
    else if (words[0] != "first" && words[0] != "last")
        return invalid("frame " + words[0] + ": not a number, first or last");
    if (!has(line.frames, wanted)) return invalid("frame " + words[0] + " is not there");
    if (wanted != line.frame) app.go_to(wanted);
    return Done{};
}
Status range(App& app, const Words& words) {
    Timeline& line = app.state.timeline;
    if (!line.is_shot()) return no_shot();
    const auto first = number_of(words[0]), last = number_of(words[1]);
    if (!first || !last || *first > *last) return invalid("range: not two frames, the first before the last");
    line.first = int(*first), line.last = int(*last);
    return Done{};
}
Status key_focus(App& app, const Words&) {
    Timeline& line = app.state.timeline;
    const auto focus = app.found_camera().focus_distance_m;
    if (!line.is_shot()) return no_shot();
    if (!focus) return invalid("no focus yet; click the subject");
    line.keys[line.frame] = focus->value;
    return Done{};
}
// Begins a rack; again: does not.
Status rack(App& app, const Words&) {
    Timeline& line = app.state.timeline;
    if (!line.is_shot() || line.first == line.last) return no_shot();
    line.rack_clicks = line.rack_clicks > 0 ? 0 : 2;
    if (line.rack_clicks == 0) return Done{};
    app.go_to(line.first);
    app.notice = "rack: click the subject in frame " + std::to_string(line.first);
    return Done{};
}
Status move_key(App& app, const Words& words) {
    Timeline& line = app.state.timeline;
    const auto from = number_of(words[0]), to = number_of(words[1]), metres = number_of(words[2]);
    if (!from || !to || !metres || !(*metres > 0)) return invalid("move_key needs two frames and a distance");
    if (!line.keys.contains(int(*from))) return invalid("there is no key at frame " + words[0]);
    if (!has(line.frames, int(*to))) return invalid("frame " + words[1] + " is not there");
    line.keys.erase(int(*from));
    line.keys[int(*to)] = *metres;
    if (const auto focus = line.focus_at(line.frame)) app.state.choice.camera.focus_distance_m = *focus;
    return Done{};
}
Status remove_key(App& app, const Words&) {
    Timeline& line = app.state.timeline;
    if (line.keys.erase(line.frame) == 0) return invalid("there is no key at this frame");
    return Done{};
}
Status save_track(App& app, const Words& words) {
    if (app.state.timeline.keys.empty()) return invalid("there are no keys yet");
    if (Status fine = app.may_write(words[0]); !fine) return fine;
    if (Status done = write_text(words[0], app.state.timeline.as_track()); !done) return done;
    app.notice = "wrote " + words[0] + "; use it with defocus --track";
    return Done{};
}
Status load_track(App& app, const Words& words) {
    if (!app.state.timeline.is_shot()) return no_shot();
    auto track = Track::read(words[0]);
    if (!track) return track.error();
    app.use_track(std::move(*track));
    app.notice = "track: " + words[0];
    return Done{};
}

}  // namespace petzval::view
