// Broken promises between our own functions stop the program and show what does not hold; bad input never
// comes here.
#pragma once

#include <cstdio>
#include <cstdlib>

// Always on. For the doors of a room, not for inner loops.
#define PETZVAL_CHECK(condition)                                                                            \
    do {                                                                                                    \
        if (!(condition)) {                                                                                 \
            std::fprintf(stderr, "petzval: broken promise at %s:%d: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                                   \
        }                                                                                                   \
    } while (false)
