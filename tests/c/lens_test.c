/* Lenses through the C door, as a lens lab uses them: without sessions, devices, files or threads. Linked with the
 * rooms of lenses alone (tests/c/CMakeLists.txt), which a shared library would not show. */
#include "expect.h"

#include <math.h>
#include <petzval/petzval_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A square of floats, r, g, b, a. */
static petzval_pixels square(float* rgba, int size) {
    petzval_pixels view = {0};
    view.size = sizeof view;
    view.width = view.height = size;
    view.r = rgba;
    view.g = rgba + 1;
    view.b = rgba + 2;
    view.a = rgba + 3;
    view.pixel_stride = 4 * sizeof(float);
    view.row_stride = view.pixel_stride * size;
    return view;
}

static petzval_disc disc_of(double radius_px, double field_x) {
    petzval_disc disc = {0};
    disc.size = sizeof disc;
    disc.coc_radius_px = radius_px;
    disc.field_x = field_x;
    return disc;
}

static double light_of(const float* rgba, int size, int channel) {
    double sum = 0;
    int i = 0;
    for (i = 0; i < size * size; ++i) sum += rgba[4 * i + channel];
    return sum;
}

static void test_a_disc_lands_in_the_callers_floats(void) {
    const petzval_disc disc = disc_of(9, 0.5);
    petzval_disc_report report = {0};
    petzval_lens* lens = NULL;
    int size = 0, small = 0;
    float* rgba = NULL;
    petzval_pixels out;
    report.size = sizeof report;
    expect(petzval_lens_open("triplet-cooke", &lens) == PETZVAL_OK, "a lens by name");
    expect(petzval_lens_disc_size(lens, NULL, &disc, &size) == PETZVAL_OK && size % 2 == 1, "a size");
    rgba = malloc((size_t)size * (size_t)size * 4 * sizeof(float));
    out = square(rgba, size);
    expect(petzval_lens_disc(lens, NULL, &disc, &out, &report) == PETZVAL_OK, "a disc");
    expect(fabs(light_of(rgba, size, 0) - 1) < 1e-4 && fabs(light_of(rgba, size, 1) - 1) < 1e-4 &&
               fabs(light_of(rgba, size, 2) - 1) < 1e-4,
           "each channel sums to 1");
    expect(report.needed_px <= size && report.needed_px > 9 && report.lost_share == 0,
           "the size holds all of it");
    small = 5;
    out = square(rgba, small);
    expect(petzval_lens_disc(lens, NULL, &disc, &out, &report) == PETZVAL_OK && report.lost_share > 0.1,
           "a smaller square loses light, and says how much");
    out = square(rgba, 4);
    expect(petzval_lens_disc(lens, NULL, &disc, &out, NULL) == PETZVAL_INVALID_ARGUMENT, "no middle pixel");
    free(rgba);
    petzval_lens_close(lens);
}

static void test_a_look_shapes_a_lens(void) {
    const petzval_disc disc = disc_of(9, 0);
    static float round[31 * 31 * 4], triangle[31 * 31 * 4];
    const petzval_pixels of_round = square(round, 31), of_triangle = square(triangle, 31);
    petzval_look* look = NULL;
    petzval_lens *lens = NULL, *shaped = NULL;
    expect(petzval_lens_open("ideal", &lens) == PETZVAL_OK, "the ideal lens");
    expect(petzval_look_new(&look) == PETZVAL_OK && petzval_look_set(look, "lens.blades", "3") == PETZVAL_OK,
           "three blades");
    expect(petzval_lens_with(lens, look, &shaped) == PETZVAL_OK, "the lens with them");
    expect(petzval_lens_disc(lens, NULL, &disc, &of_round, NULL) == PETZVAL_OK &&
               petzval_lens_disc(shaped, NULL, &disc, &of_triangle, NULL) == PETZVAL_OK,
           "discs of both");
    expect(memcmp(round, triangle, sizeof round) != 0, "which differ");
    expect(petzval_look_set(look, "lens.blades", "2") == PETZVAL_INVALID_ARGUMENT, "two blades are refused");
    petzval_look_close(look);
    petzval_lens_close(shaped);
    petzval_lens_close(lens);
}

static void test_facts_section_and_curves_are_json(void) {
    petzval_lens* lens = NULL;
    petzval_text* text = NULL;
    expect(petzval_lens_open("petzval-laikin", &lens) == PETZVAL_OK, "a lens");
    expect(strcmp(petzval_lens_title(lens), "petzval-laikin") == 0, "its name");
    expect(petzval_lens_facts(lens, &text) == PETZVAL_OK && strstr(petzval_text_json(text), "\"efl_mm\":"),
           "facts");
    expect(strstr(petzval_text_json(text), "\"object_distance_mm\":1e999") != NULL, "infinity is a number");
    petzval_text_close(text);
    expect(petzval_lens_curves(lens, &text) == PETZVAL_OK && strstr(petzval_text_json(text), "\"pupil_zone\""),
           "curves");
    petzval_text_close(text);
    expect(petzval_lens_section(lens, NULL, 2.0, 0.3, 0, 11, &text) == PETZVAL_OK &&
               strstr(petzval_text_json(text), "\"path_mm\":[["),
           "a section with rays");
    petzval_text_close(text);
    expect(petzval_lens_section(lens, NULL, -1, 0, 0, 11, &text) == PETZVAL_INVALID_ARGUMENT && text == NULL,
           "depth below 0 is refused");
    expect(petzval_lens_list(&text) == PETZVAL_OK && strstr(petzval_text_json(text), "triplet-cooke"),
           "the list of lenses");
    petzval_text_close(text);
    petzval_text_close(NULL);
    petzval_lens_close(lens);
}

static void test_a_texture_holds_all_discs(void) {
    enum { COLUMNS = 16 };
    double radii[COLUMNS];
    petzval_texture texture = {0};
    petzval_lens* lens = NULL;
    petzval_pixels out;
    float* rgba = NULL;
    int rows = 0, used = 0;
    texture.size = sizeof texture;
    texture.columns = COLUMNS;
    texture.largest_coc_px = 8;
    texture.threads = 1;
    expect(petzval_lens_open("doublet", &lens) == PETZVAL_OK, "a lens of curves");
    expect(petzval_lens_texture_rows(lens, NULL, &texture, &rows) == PETZVAL_OK && rows > 32, "rows");
    rgba = calloc((size_t)rows * COLUMNS * 4, sizeof(float));
    out = square(rgba, COLUMNS);
    expect(petzval_lens_texture(lens, NULL, &texture, &out, radii, &used) == PETZVAL_INVALID_ARGUMENT,
           "too few rows are refused");
    out.height = rows;
    expect(petzval_lens_texture(lens, NULL, &texture, &out, radii, &used) == PETZVAL_OK, "a texture");
    expect(used <= rows && used > 30 && radii[0] == -8 && radii[COLUMNS - 1] == 8, "from near to far");
    free(rgba);
    petzval_lens_close(lens);
}

static void test_an_atlas_lands_in_the_callers_bytes(void) {
    enum { BYTES = 4 * 31 * 31 * 14 * 2 };
    static unsigned char texels[BYTES];
    petzval_atlas atlas = {0};
    petzval_lens* lens = NULL;
    petzval_text* header = NULL;
    size_t bytes = 0;
    atlas.size = sizeof atlas;
    expect(petzval_lens_atlas_bytes(NULL, &bytes) == PETZVAL_OK && 2 * bytes == 5 * (size_t)BYTES, "five zones");
    atlas.zones = 2;
    atlas.largest_coc_px = 9;
    expect(petzval_lens_atlas_bytes(&atlas, &bytes) == PETZVAL_OK && bytes == BYTES, "two zones");
    expect(petzval_lens_open("doublet", &lens) == PETZVAL_OK, "a lens of curves");
    expect(petzval_lens_atlas(lens, NULL, &atlas, texels, BYTES - 1, &header) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "byte_count") && header == NULL,
           "too few bytes are refused");
    expect(petzval_lens_atlas(lens, NULL, &atlas, texels, BYTES, &header) == PETZVAL_OK, "an atlas");
    expect(strstr(petzval_text_json(header), "\"radii_px\":[-9.0,") != NULL, "its header");
    expect(texels[BYTES - 1] >> 3 <= 24 && texels[4 * (15 * 14 * 31 + 15) + 3] >> 3 > 10, "its light");
    petzval_text_close(header);
    atlas.zones = 65;
    expect(petzval_lens_atlas_bytes(&atlas, &bytes) == PETZVAL_INVALID_ARGUMENT, "65 zones are refused");
    petzval_lens_close(lens);
}

static void test_an_atlas_of_rings_is_of_a_round_pupil(void) {
    static unsigned char texels[4 * 31 * 31 * 14 * 5];
    petzval_lens_mount mount = {0};
    petzval_lens *lens = NULL, *bladed = NULL;
    petzval_look* look = NULL;
    petzval_text* header = NULL;
    mount.size = sizeof mount;
    mount.pixel_aspect = 2;
    expect(petzval_lens_open("ideal", &lens) == PETZVAL_OK && petzval_look_new(&look) == PETZVAL_OK &&
               petzval_look_set(look, "lens.blades", "5") == PETZVAL_OK &&
               petzval_lens_with(lens, look, &bladed) == PETZVAL_OK,
           "five blades");
    expect(petzval_lens_atlas(bladed, NULL, NULL, texels, sizeof texels, &header) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "lens.blades") && header == NULL,
           "blades are refused by name");
    expect(petzval_lens_atlas(lens, &mount, NULL, texels, sizeof texels, &header) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "mount.pixel_aspect"),
           "so are pixels that are not square");
    petzval_look_close(look);
    petzval_lens_close(bladed);
    petzval_lens_close(lens);
}

static char* content_of(const char* path, size_t* size) {
    FILE* file = fopen(path, "rb");
    char* bytes = malloc(1 << 20);
    *size = file ? fread(bytes, 1, 1 << 20, file) : 0;
    if (file) fclose(file);
    return bytes;
}

static void test_a_lens_of_memory_is_the_lens_of_the_file(const char* path) {
    const petzval_disc disc = disc_of(-6, 0.2);
    static float by_file[41 * 41 * 4], by_memory[41 * 41 * 4];
    const petzval_pixels of_file = square(by_file, 41), of_memory = square(by_memory, 41);
    petzval_lens *read = NULL, *given = NULL, *none = NULL;
    size_t size = 0;
    char* const bytes = content_of(path, &size);
    expect(petzval_lens_open(path, &read) == PETZVAL_OK, "a file");
    expect(petzval_lens_from_memory(bytes, size, "mine", &given) == PETZVAL_OK, "its content");
    expect(petzval_lens_disc(read, NULL, &disc, &of_file, NULL) == PETZVAL_OK &&
               petzval_lens_disc(given, NULL, &disc, &of_memory, NULL) == PETZVAL_OK &&
               memcmp(by_file, by_memory, sizeof by_file) == 0,
           "the same discs, bit for bit");
    expect(petzval_lens_from_memory(bytes, size / 3, "mine", &none) == PETZVAL_INVALID_FILE && none == NULL,
           "a third of it is refused");
    expect(strstr(petzval_error_text(), "mine") != NULL, "by its name");
    expect(petzval_lens_from_memory("", 0, NULL, &none) == PETZVAL_INVALID_FILE, "nothing at all, too");
    expect(petzval_lens_open("no such lens", &none) == PETZVAL_INVALID_ARGUMENT && none == NULL, "no name");
    free(bytes);
    petzval_lens_close(read);
    petzval_lens_close(given);
}

int main(int count, char** arguments) {
    if (count < 2) return 2;
    test_a_disc_lands_in_the_callers_floats();
    test_a_look_shapes_a_lens();
    test_facts_section_and_curves_are_json();
    test_a_texture_holds_all_discs();
    test_an_atlas_lands_in_the_callers_bytes();
    test_an_atlas_of_rings_is_of_a_round_pupil();
    test_a_lens_of_memory_is_the_lens_of_the_file(arguments[1]);
    printf("%d failures\n", failures);
    return failures > 0;
}
