#include "overlay.h"

#include "host.h"
#include "params.h"

#include <cmath>
#include <string_view>

namespace petzval::plugin {
namespace {

// The instance that has the pen between its going down and up; hosts have one pen.
ofx::Effect* dragged = nullptr;

constexpr double kReach = 10;  // screen pixels around the point that take hold of it, and half of the cross

bool is_in_use(ofx::Effect* effect, ofx::Time time) {
    return values_at(effect, time).focus_from == FocusFrom::Point;
}

int draw(ofx::Effect* effect, const Properties& in) {
    auto* context = static_cast<ofx::DrawContext*>(in.pointer(ofx::kDrawContext));
    const ofx::DrawSuite* suite = suites().draw;
    const ofx::Time time = in.number(ofx::kTime);
    if (!context || !suite || !is_in_use(effect, time)) return ofx::kReplyDefault;
    const ofx::Point at = values_at(effect, time).focus_point;
    const ofx::Point pixel = in.point(ofx::kPixelScale, {1, 1});
    const double x = kReach * pixel.x, y = kReach * pixel.y;
    ofx::Colour colour{1, 1, 1, 1};
    suite->standard_colour(context, dragged == effect ? ofx::kOverlaySelected : ofx::kOverlayActive, &colour);
    suite->set_colour(context, &colour);
    suite->set_line_width(context, 1);
    const ofx::Point cross[] = {{at.x - x, at.y}, {at.x + x, at.y}, {at.x, at.y - y}, {at.x, at.y + y}};
    suite->draw(context, ofx::kLines, cross, 4);
    const ofx::Point corners[] = {{at.x - x / 2, at.y - y / 2}, {at.x + x / 2, at.y + y / 2}};
    suite->draw(context, ofx::kEllipse, corners, 2);
    return ofx::kOk;
}

int move_to(ofx::Effect* effect, const ofx::Point& at) {
    ofx::Param* param = param_of(effect, name::kFocusPoint);
    if (!param) return ofx::kReplyDefault;
    suites().parameter->set_value(param, at.x, at.y);
    return ofx::kOk;
}

int pen(std::string_view action, ofx::Effect* effect, const Properties& in) {
    const ofx::Time time = in.number(ofx::kTime);
    const ofx::Point at = in.point(ofx::kPenPosition, {0, 0});
    if (!is_in_use(effect, time)) return ofx::kReplyDefault;
    if (action == ofx::action::kPenUp) {
        const bool was_dragged = dragged == effect;
        dragged = nullptr;
        return was_dragged ? ofx::kOk : ofx::kReplyDefault;
    }
    if (action == ofx::action::kPenDown) {
        const ofx::Point point = values_at(effect, time).focus_point;
        const ofx::Point pixel = in.point(ofx::kPixelScale, {1, 1});
        const bool near =
            std::abs(at.x - point.x) <= kReach * pixel.x && std::abs(at.y - point.y) <= kReach * pixel.y;
        if (!near) return ofx::kReplyDefault;
        dragged = effect;
    }
    return dragged == effect ? move_to(effect, at) : int(ofx::kReplyDefault);
}

}  // namespace

int overlay_main(const char* action, const void*, ofx::PropertySet* in, ofx::PropertySet*) {
    const std::string_view name = action ? action : "";
    const Properties arguments(in);
    auto* effect = static_cast<ofx::Effect*>(arguments.pointer(ofx::kEffectInstance));
    if (name == ofx::action::kDescribe || name == ofx::action::kCreate || name == ofx::action::kDestroy)
        return ofx::kOk;
    if (!effect) return ofx::kReplyDefault;
    if (name == ofx::action::kDraw) return draw(effect, arguments);
    if (name == ofx::action::kPenDown || name == ofx::action::kPenMotion || name == ofx::action::kPenUp)
        return pen(name, effect, arguments);
    return ofx::kReplyDefault;
}

}  // namespace petzval::plugin
