// Fields of the panel Input: which layers of which files, and the meaning of their depth.
#include "petzval/names.h"

#include "field_list.h"
#include "fields.h"

namespace petzval::view {
namespace {

constexpr const char* kOfFile = "file";  // stands for: as the file says

Field name_field(const char* name, std::string InputChoice::*of) {
    return {name,
            [=](const App& app) {
                const std::string& text = app.state.choice.input.*of;
                return text.empty() ? std::string(kOfFile) : text;
            },
            [=](App& app, const std::string& text) -> Status {
                app.state.choice.input.*of = text == kOfFile ? "" : text;
                return Done{};
            },
            kOfFile};
}

Field kind() {
    return {
        "input.depth_kind",
        [](const App& app) {
            const auto& kind = app.state.choice.input.depth_kind;
            return kind ? std::string(name_of(*kind)) : std::string(kOfFile);
        },
        [](App& app, const std::string& text) -> Status {
            InputChoice& input = app.state.choice.input;
            if (text == kOfFile) {
                input.depth_kind.reset();
                return Done{};
            }
            const auto kind = parse<DepthKind>(text);
            if (!kind)
                return Error{ErrorCode::InvalidArgument, "depth kind " + text + ": " + kind.error().message};
            input.depth_kind = *kind;
            return Done{};
        },
        kOfFile};
}

// "0.1,100", in units of the scene.
Field range() {
    return {
        "input.depth_range",
        [](const App& app) {
            const InputChoice& input = app.state.choice.input;
            if (!input.depth_near || !input.depth_far) return std::string(kOfFile);
            return text_of(*input.depth_near, 9) + "," + text_of(*input.depth_far, 9);
        },
        [](App& app, const std::string& text) -> Status {
            InputChoice& input = app.state.choice.input;
            if (text == kOfFile || text.empty()) {
                input.depth_near.reset();
                input.depth_far.reset();
                return Done{};
            }
            const std::size_t comma = text.find(',');
            const auto near = number_of(text.substr(0, comma));
            const auto far = number_of(comma == std::string::npos ? "" : text.substr(comma + 1));
            if (!near || !far)
                return Error{ErrorCode::InvalidArgument, "depth range " + text + ": not NEAR,FAR as 0.1,100"};
            input.depth_near = *near;
            input.depth_far = *far;
            return Done{};
        },
        kOfFile};
}

Field unit() {
    return {"input.unit_scale_m",
            [](const App& app) { return text_of(app.state.choice.input.unit_scale_m, 9); },
            [](App& app, const std::string& text) -> Status {
                const auto metres = number_of(text);
                if (!metres || !(*metres > 0))
                    return Error{ErrorCode::InvalidArgument,
                                 "metres per unit " + text + ": not a number above 0"};
                app.state.choice.input.unit_scale_m = *metres;
                return Done{};
            },
            "1"};
}

}  // namespace

std::vector<Field> input_fields() {
    return {{"input.path", [](const App& app) { return app.state.choice.input.path; }, nullptr},
            name_field("input.layer", &InputChoice::layer),
            name_field("input.view", &InputChoice::view_name),
            name_field("input.depth_file", &InputChoice::depth_file),
            name_field("input.depth_channel", &InputChoice::depth_channel),
            kind(),
            range(),
            unit()};
}

}  // namespace petzval::view
