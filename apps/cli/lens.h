// The lens of a command.
#pragma once

#include "petzval/lens_choice.h"

#include "flags.h"
#include "lens_character.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct LensFlags {
    std::string name = "ideal";
    std::optional<int> blades;
    std::optional<double> rotation_deg, curvature, squeeze, cats_eye;

    LensCharacterFlags character;

    void add_to(Verb& verb);            // name and shape
    void add_shape_to(Verb& verb);      // blades, squeeze, cat's eye
    void add_character_to(Verb& verb);  // the rest
    void check() const;                 // throws UsageError for flags that would have no effect
    // Files that are read: a lens file, images.
    std::vector<std::string> input_files() const;
    // Reads images; before choice() where there are any.
    Status load(int threads) { return character.load(threads); }
    LensChoice choice() const;
};

}  // namespace petzval::cli
