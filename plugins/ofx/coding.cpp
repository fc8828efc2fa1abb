#include "coding.h"

namespace petzval::plugin {

void Coding::to_light(float* rgba) const {
    const float alpha = rgba[3];
    if (transfer == Transfer::Linear) {
        for (int c = 0; c < 3 && is_unpremultiplied; ++c) rgba[c] *= alpha;
        return;
    }
    const float share = alpha > 0 && !is_unpremultiplied ? alpha : 1;
    for (int c = 0; c < 3; ++c)
        rgba[c] = float(decode(transfer, double(rgba[c] / share))) * (is_unpremultiplied ? alpha : share);
}

void Coding::from_light(float* rgba) const {
    const float share = rgba[3] > 0 ? rgba[3] : 1;
    for (int c = 0; c < 3; ++c) {
        const float colour = rgba[c] / share;
        const float code = transfer == Transfer::Linear ? colour : float(encode(transfer, double(colour)));
        rgba[c] = is_unpremultiplied ? code : code * share;
    }
}

}  // namespace petzval::plugin
