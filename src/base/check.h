// An internal error, which is a condition between our own functions that does not hold, stops the program and
// shows the condition. Bad input never leads here.
#pragma once

#include <cstdio>
#include <cstdlib>

// Always on. For the doors of a room, not for inner loops.
#define PETZVAL_CHECK(condition)                                                                            \
    do {                                                                                                    \
        if (!(condition)) {                                                                                 \
            std::fprintf(stderr, "petzval: internal error at %s:%d: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                                   \
        }                                                                                                   \
    } while (false)
