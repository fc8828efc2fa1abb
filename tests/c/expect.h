/* Counts failed expectations of a C test, whose main() fails if there are any. */
#ifndef PETZVAL_TEST_EXPECT_H
#define PETZVAL_TEST_EXPECT_H

#include <petzval/petzval_c.h>
#include <stdio.h>

static int failures = 0;

static void expect(int holds, const char* what) {
    if (holds) return;
    printf("failed: %s (last error: %s)\n", what, petzval_error_text());
    ++failures;
}

#endif
