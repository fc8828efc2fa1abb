// Sessions and reports as C hosts hold them.
#pragma once

#include "petzval/petzval_c.h"
#include "petzval/session.h"

#include <string>

struct petzval_session {
    petzval::Session session;
};

struct petzval_report {
    std::string json;
};
