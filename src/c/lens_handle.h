// A lens as C hosts hold it.
#pragma once

#include "petzval/lens.h"
#include "petzval/petzval_c.h"

#include <string>

struct petzval_lens {
    petzval::Lens lens;
};
