// Conversion of the host's colours to premultiplied light, and back.
#pragma once

#include "petzval/develop.h"

namespace petzval::plugin {

struct Coding {
    Transfer transfer = Transfer::Linear;
    bool is_unpremultiplied = false;

    bool is_premultiplied_light() const { return transfer == Transfer::Linear && !is_unpremultiplied; }
    // One RGBA pixel each. Display codes are of the colour before it is premultiplied; where alpha is 0,
    // premultiplied light and codes are converted as they are.
    void to_light(float* rgba) const;
    void from_light(float* rgba) const;
};

}  // namespace petzval::plugin
