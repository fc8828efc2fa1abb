// Focus that moves in one frame by more than was sharp before it, and not because the keys of a track have it
// move so.
#pragma once

#include "petzval/reports/words.h"

#include "records/record_json.h"

#include <cmath>
#include <optional>
#include <string>

namespace petzval::sequence {

using records::Json;

class FocusJumps {
public:
    // Adds a warning to the record of a frame whose focus jumped. between_keys: as in TrackedFrame.
    void look_at(int frame, bool between_keys, Json& record) {
        const Json focus = record.value("camera", Json::object()).value("focus_distance_m", Json(nullptr));
        const Json limits = record.value("focus_limits", Json(nullptr));
        const bool follows = last_ && frame == last_->frame + 1 && !between_keys && !last_->between_keys;
        if (!focus.is_number() || !limits.is_object()) return last_.reset();
        const auto metres = [](const Json& value) { return value.is_number() ? double(value) : HUGE_VAL; };
        if (follows && (double(focus) < last_->near_m || double(focus) > last_->far_m))
            record["warnings"].push_back("frame " + std::to_string(frame) + ": the focus jumps from " +
                                         plain(last_->focus_m, 3) + " to " + plain(focus, 3) +
                                         " m, beyond the depth of field of the frame before (" +
                                         plain(last_->near_m, 3) + " to " + plain(last_->far_m, 3) + " m)");
        last_ = {frame, between_keys, double(focus), metres(limits["near_m"]), metres(limits["far_m"])};
    }

private:
    struct Before {
        int frame;
        bool between_keys;
        double focus_m, near_m, far_m;
    };
    std::optional<Before> last_;
};

}  // namespace petzval::sequence
