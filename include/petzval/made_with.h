// The settings that made a picture, stored in the picture itself. A later run compares them with its own to
// decide whether the picture is current. Component petzval::files.
#pragma once

#include "petzval/display_files.h"
#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// The attribute of an EXR, and the keyword of a PNG's text.
inline constexpr const char* kMadeWith = "petzval:madeWith";

// Settings by their field names, such as lens.blades, each with its value as JSON. It does not contain
// settings at their defaults, nor settings that change no pixel, such as threads, memory and output paths.
class PETZVAL_API MadeWith {
public:
    void add(const std::string& field, const std::string& text);
    void add(const std::string& field, double value);
    void add(const std::string& field,
             const std::optional<double>& value);  // adds nothing if it is not given
    // Each call adds the fields that were chosen: of a look, those that differ from their defaults; of a
    // source, likewise, with its camera and without file names; of a display choice, those that were given.
    void add(const Look& look);
    void add(const ShotSource& source);
    void add(const DisplayChoice& display);
    // Adds a digest of the names of input files, so that a delivered picture reveals no folders.
    void add_files(const std::vector<std::string>& names);

    // One line of JSON: the version of petzval, then every setting. The same settings have the same text.
    std::string text() const;
    // The differences between the settings in `text_of_picture` and these, such as "camera.f_number was 2.8
    // and is 4". Empty if both are the same.
    std::string difference(const std::string& text_of_picture) const;

private:
    std::map<std::string, std::string> settings_;  // JSON by field
};

// The treatment of outputs that already exist.
enum class ExistingOutputs {
    Replace,
    Keep,    // existing outputs are kept
    Update,  // existing outputs are kept if newer than all inputs and made with the same settings
};

struct OutputState {
    bool is_kept = false;
    std::string why;  // why it is kept or, for Update, made again; may be empty
};

// Decides whether existing outputs are kept. The first output is the picture that holds the settings;
// ExistingOutputs::Update compares them with `made_with`, if given.
PETZVAL_API OutputState state_of(const std::vector<std::string>& outputs,
                                 const std::vector<std::string>& inputs, ExistingOutputs existing,
                                 const MadeWith* made_with = nullptr);

// True if an EXR or PNG can be read to its end. Another program or a full disk may have truncated it.
PETZVAL_API bool is_whole_picture(const std::string& path);

// For outputs that are kept one by one: "PATH: kept, although it is damaged or cut off" for each picture
// among them that is not whole. (A FrameLoop makes such frames again.)
PETZVAL_API std::vector<std::string> damage_of_kept(const std::vector<std::string>& outputs);

}  // namespace petzval
