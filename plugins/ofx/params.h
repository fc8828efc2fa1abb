// Parameters of the effect: their description, and their values at a time.
#pragma once

#include "petzval/depth.h"
#include "petzval/develop.h"

#include "host.h"

#include <string>
#include <string_view>
#include <vector>

namespace petzval::plugin {

// Names that scripts and saved projects use; none is ever renamed.
namespace name {
inline constexpr const char* kLens = "lens";
inline constexpr const char* kLensMenu = "lensMenu";
inline constexpr const char* kPreset = "preset";
inline constexpr const char* kPresetMenu = "presetMenu";
inline constexpr const char* kFocusPoint = "focusPoint";
inline constexpr const char* kTransfer = "transfer";
inline constexpr const char* kFocusFrom = "focusFrom";
}  // namespace name

enum class FocusFrom { Distance, Point };
enum class DepthFrom { Auto, Clip, File, Alpha };
enum class SensorSpans { Project, Source };

struct Values {
    double focal_length_mm = 50, sensor_width_mm = 36, f_number = 2.8, focus_distance_m = 3;
    FocusFrom focus_from = FocusFrom::Distance;
    ofx::Point focus_point{};      // canonical
    bool focus_is_middle = false;  // of the frame, instead of focus_point
    SensorSpans sensor_spans = SensorSpans::Project;
    Transfer transfer = Transfer::Linear;  // of Source, Plate and Output
    DepthFrom depth_from = DepthFrom::Auto;
    std::string depth_file, depth_channel;
    DepthKind depth_kind = DepthKind::Planar;
    double depth_unit_m = 1, depth_near = 0, depth_far = 0;
    double depth_frame_offset = 0;  // frames of the depth file, added to the host's time
    std::string lens, look, preset;
    std::string engine, quality;  // empty: those of the look
    bool draft_when_interactive = true;
};

void define_params(ofx::Effect* descriptor);
// Defaults stand where the host has no value.
Values values_at(ofx::Effect* instance, ofx::Time time);
// The user has chosen in the menu of that name, which writes into a text: of lenses into `lens`, of presets
// into `preset`. The menu then shows its first entry again: an entry that stays chosen is used where the text
// is empty, in hosts that report no changes. False, and nothing happens, for other names.
bool take_word_of_menu(ofx::Effect* instance, std::string_view menu, ofx::Time time);

// The library's messages name fields, as depth.kind; hosts show labels of parameters.
std::string in_labels(std::string message);

ofx::Param* param_of(ofx::Effect* instance, const char* name);

}  // namespace petzval::plugin
