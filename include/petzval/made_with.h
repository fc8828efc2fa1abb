// What a picture was made with, kept in the picture itself, so that a later run can tell whether it would
// make another one. Component petzval::files.
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

// Settings by their field names, as lens.blades, each with its value as JSON. Settings that are left at their
// defaults are not among them, and neither are those that change no pixel: threads, memory, where results go.
class PETZVAL_API MadeWith {
public:
    void add(const std::string& field, const std::string& text);
    void add(const std::string& field, double value);
    void add(const std::string& field, const std::optional<double>& value);  // nothing where it is not given
    // Every field of the look that is not at its default; the same of where a shot is, but for names of
    // files, and its camera; of a display choice what is given.
    void add(const Look& look);
    void add(const ShotSource& source);
    void add(const DisplayChoice& display);
    // Names of files that are read, as a digest: a picture that is handed on tells no folders.
    void add_files(const std::vector<std::string>& names);

    // One line of JSON: the version of petzval, then every setting. The same settings have the same text.
    std::string text() const;
    // How the settings of a picture with that text differ from these, as "camera.f_number was 2.8 and is 4";
    // empty where they are the same.
    std::string difference(const std::string& text_of_picture) const;

private:
    std::map<std::string, std::string> settings_;  // JSON by field
};

// What becomes of outputs that are there already.
enum class ExistingOutputs {
    Replace,
    Keep,    // they are left alone
    Update,  // they are left alone where they are newer than all inputs and made with the same settings
};

struct OutputState {
    bool is_kept = false;
    std::string why;  // it is kept; or, of Update, what is there is made again; may be empty
};

// Of Update, `made_with` is compared where it is given: the first output is the picture that holds it.
PETZVAL_API OutputState state_of(const std::vector<std::string>& outputs,
                                 const std::vector<std::string>& inputs, ExistingOutputs existing,
                                 const MadeWith* made_with = nullptr);

// Whether a picture, EXR or PNG, can be read to its end: another program or a full disk may have cut it off.
PETZVAL_API bool is_whole_picture(const std::string& path);

}  // namespace petzval
