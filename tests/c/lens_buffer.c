/* A host of the shader kit in C: writes the buffer of a lens with a cat's eye into a file.
 * Usage: lens_buffer LENS CATS_EYE QUALITY OUT. tests/python/files_test.py compares its bytes with others'. */
#include "expect.h"

#include <petzval/petzval_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void test_wrong_arguments_are_refused(const petzval_lens* lens, const petzval_lens_mount* mount, void* buffer,
                                             size_t bytes) {
    petzval_lens_mount wide = *mount;
    size_t unchanged = 7;
    wide.pixel_aspect = 2;
    expect(petzval_lens_buffer(lens, mount, NULL, buffer, 16) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "byte_count is 16"),
           "too few bytes");
    expect(petzval_lens_buffer_bytes(lens, mount, "best", &unchanged) == PETZVAL_INVALID_ARGUMENT && unchanged == 7 &&
               strstr(petzval_error_text(), "draft, standard, final"),
           "a quality that does not exist");
    expect(petzval_lens_buffer(lens, &wide, NULL, buffer, bytes) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "mount.pixel_aspect"),
           "pixels that are not square");
    expect(petzval_lens_buffer(NULL, mount, NULL, buffer, bytes) == PETZVAL_INVALID_ARGUMENT, "no lens");
    expect(petzval_lens_buffer(lens, mount, NULL, NULL, bytes) == PETZVAL_INVALID_ARGUMENT, "no buffer");
}

static void test_only_its_own_buffers_are_taken(char* buffer, size_t bytes) {
    char mark[4];
    expect(petzval_check_lens_buffer(buffer, bytes) == PETZVAL_OK, "its own buffer");
    expect(petzval_check_lens_buffer(buffer, bytes - 16) == PETZVAL_INVALID_FILE, "a cut buffer");
    expect(petzval_check_lens_buffer("GIF89a", 6) == PETZVAL_INVALID_FILE, "another file");
    expect(petzval_check_lens_buffer(NULL, bytes) == PETZVAL_INVALID_ARGUMENT, "no bytes");
    memcpy(mark, buffer + 16, 4);
    memset(buffer + 16, 0, 4);
    expect(petzval_check_lens_buffer(buffer, bytes) == PETZVAL_INVALID_FILE &&
               strstr(petzval_error_text(), "no mark PZL2 at byte 16"),
           "a buffer of an older version");
    memcpy(buffer + 16, mark, 4);
}

static void write_file(const char* path, const void* buffer, size_t bytes) {
    FILE* const file = fopen(path, "wb");
    expect(file && fwrite(buffer, 1, bytes, file) == bytes && fclose(file) == 0, "a file");
}

int main(int count, char** arguments) {
    petzval_lens_mount mount = {0};
    petzval_lens *round = NULL, *lens = NULL;
    petzval_look* look = NULL;
    void* buffer = NULL;
    size_t bytes = 0;
    if (count != 5) return 2;
    mount.size = sizeof mount;
    mount.width = 960;
    mount.height = 540;
    expect(petzval_lens_open(arguments[1], &round) == PETZVAL_OK && petzval_look_new(&look) == PETZVAL_OK &&
               petzval_look_set(look, "lens.cats_eye", arguments[2]) == PETZVAL_OK &&
               petzval_lens_with(round, look, &lens) == PETZVAL_OK,
           "a lens");
    expect(petzval_lens_buffer_bytes(lens, &mount, arguments[3], &bytes) == PETZVAL_OK, "its size");
    buffer = malloc(bytes);
    test_wrong_arguments_are_refused(lens, &mount, buffer, bytes);
    expect(petzval_lens_buffer(lens, &mount, arguments[3], buffer, bytes) == PETZVAL_OK, "its bytes");
    test_only_its_own_buffers_are_taken(buffer, bytes);
    write_file(arguments[4], buffer, bytes);
    free(buffer);
    petzval_look_close(look);
    petzval_lens_close(lens);
    petzval_lens_close(round);
    return failures > 0;
}
