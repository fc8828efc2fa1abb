// A lens, ready to be mounted on a camera.
#pragma once

#include "petzval/export.h"
#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include <memory>
#include <string>
#include <string_view>

namespace petzval {

enum class LensModelKind {
    Ideal,         // a flat disc
    Curves,        // longitudinal aberration curves
    Prescription,  // surfaces and glass, traced
};

// An opened lens: a LensChoice that was read, checked and named by its content once. Cheap to copy: copies
// share the data. It never changes, even if its file does; many threads may use it.
class PETZVAL_API Lens {
public:
    // Errors: InvalidArgument naming an unknown lens or an option out of range; InvalidFile for a lens file
    // that is missing, damaged or no regular file. Options that need a camera are checked when the lens is
    // mounted.
    static Result<Lens> open(const LensChoice& choice);
    // The content of a lens file, in any of the formats of docs/reference/lens-files.md; `name` stands for it
    // in messages and reports. Errors: InvalidFile for bytes that describe no lens.
    static Result<Lens> read(std::string_view bytes, const std::string& name);
    // The same lens with other options: `choice` sets everything except the name. No file is read. Errors:
    // as above.
    Result<Lens> with(const LensChoice& choice) const;

    const LensChoice& choice() const;
    const std::string& name() const { return choice().name; }  // as asked for
    LensModelKind kind() const;
    // True for the ideal lens and lenses described by curves, not for those with surfaces.
    bool is_drawn() const { return kind() != LensModelKind::Prescription; }
    // True if a kernel of given radius changes with the focus distance.
    bool depends_on_focus() const;
    // Identifies the content: the lens's data and every option, images included. 32 hexadecimal digits.
    const std::string& key() const;

    struct Contents;
    const Contents& contents() const { return *contents_; }

private:
    explicit Lens(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}
    std::shared_ptr<const Contents> contents_;
};

}  // namespace petzval
