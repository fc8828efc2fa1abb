// The effect described to the host.
#pragma once

#include "host.h"

namespace petzval::plugin {

int describe(ofx::Effect* descriptor);
int describe_in_context(ofx::Effect* descriptor);
int clip_preferences(ofx::Effect* effect, Properties out);

}  // namespace petzval::plugin
