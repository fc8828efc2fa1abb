// Actions of the host about frames.
#pragma once

#include "host.h"

namespace petzval::plugin {

// The session that all instances share. Errors are kept and shown by the first frame.
void open_session();
void close_session();

int render(ofx::Effect* effect, const Properties& in);
int is_identity(ofx::Effect* effect, const Properties& in, Properties out);
int regions_of_interest(ofx::Effect* effect, const Properties& in, Properties out);
int region_of_definition(ofx::Effect* effect, const Properties& in, Properties out);

}  // namespace petzval::plugin
