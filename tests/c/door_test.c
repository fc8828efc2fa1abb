/* The C door, used as a C host uses it: every function, pictures in a host's own layout, errors, old structs.
 */
#include "expect.h"

#include <math.h>
#include <petzval/petzval_c.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 48, HEIGHT = 32 };

/* A lamp at (20, 16) on black, RGBA, rows top-down or bottom-up. */
typedef struct picture {
    float rgba[HEIGHT][WIDTH][4];
} picture;

static petzval_pixels pixels_of(picture* p, int bottom_up) {
    petzval_pixels view = {0};
    float* first = bottom_up ? p->rgba[HEIGHT - 1][0] : p->rgba[0][0];
    view.size = sizeof view;
    view.width = WIDTH;
    view.height = HEIGHT;
    view.sample = PETZVAL_FLOAT;
    view.r = first;
    view.g = first + 1;
    view.b = first + 2;
    view.a = first + 3;
    view.pixel_stride = 4 * sizeof(float);
    view.row_stride = (bottom_up ? -1 : 1) * (ptrdiff_t)sizeof p->rgba[0];
    return view;
}

static float* at(picture* p, int x, int y, int bottom_up) {
    return p->rgba[bottom_up ? HEIGHT - 1 - y : y][x];
}

static void paint(picture* p, int bottom_up) {
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            float* pixel = at(p, x, y, bottom_up);
            pixel[0] = pixel[1] = pixel[2] = x == 20 && y == 16 ? 100.0f : 0.0f;
            pixel[3] = 1;
        }
}

/* All of it lies 5 px behind focus. */
static float radii[HEIGHT][WIDTH];
static petzval_plane radii_plane(void) {
    petzval_plane plane = {0};
    plane.size = sizeof plane;
    plane.width = WIDTH;
    plane.height = HEIGHT;
    plane.sample = PETZVAL_FLOAT;
    plane.data = radii;
    plane.pixel_stride = sizeof(float);
    plane.row_stride = sizeof radii[0];
    return plane;
}

static int ask_and_cancel(void* host, double done) {
    (void)done;
    ++*(int*)host;
    return 0;
}

static petzval_status defocus(petzval_session* session, const petzval_look* look, picture* from, picture* to,
                              int bottom_up, const petzval_control* control, petzval_report** report) {
    const petzval_pixels colour = pixels_of(from, bottom_up), out = pixels_of(to, bottom_up);
    const petzval_plane plane = radii_plane();
    petzval_shot shot = {0};
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
    return petzval_defocus(session, &shot, look, control, &out, report);
}

static void test_a_lamp_becomes_a_disc_of_the_same_light(petzval_session* session) {
    static picture in, out;
    petzval_report* report = NULL;
    double light = 0;
    paint(&in, 0);
    expect(defocus(session, NULL, &in, &out, 0, NULL, &report) == PETZVAL_OK, "a frame");
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) light += out.rgba[y][x][0];
    expect(fabs(light - 100) < 0.1, "a disc has the light of its lamp");
    expect(out.rgba[16][20][0] > 0.5f && out.rgba[16][20][0] < 5, "spread over some 80 pixels");
    expect(strstr(petzval_report_json(report), "\"engine\": \"scatter\"") != NULL,
           "the report names the engine");
    petzval_report_close(report);
}

static void test_rows_may_lie_bottom_up(petzval_session* session) {
    static picture down_in, down_out, up_in, up_out;
    int same = 1;
    paint(&down_in, 0);
    paint(&up_in, 1);
    expect(defocus(session, NULL, &down_in, &down_out, 0, NULL, NULL) == PETZVAL_OK, "top-down");
    expect(defocus(session, NULL, &up_in, &up_out, 1, NULL, NULL) == PETZVAL_OK, "bottom-up");
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            same = same && memcmp(at(&down_out, x, y, 0), at(&up_out, x, y, 1), 4 * sizeof(float)) == 0;
    expect(same, "the same picture either way up, bit for bit");
}

static void test_a_frame_may_be_made_in_place(petzval_session* session) {
    static picture in, out, both;
    paint(&in, 0);
    paint(&both, 0);
    expect(defocus(session, NULL, &in, &out, 0, NULL, NULL) == PETZVAL_OK, "elsewhere");
    expect(defocus(session, NULL, &both, &both, 0, NULL, NULL) == PETZVAL_OK, "in place");
    expect(memcmp(&out, &both, sizeof out) == 0, "in place is the same");
}

static void test_looks(petzval_session* session) {
    static picture in, round, pentagon;
    petzval_look *look = NULL, *again = NULL;
    const char* json = NULL;
    paint(&in, 0);
    expect(petzval_look_new(&look) == PETZVAL_OK, "a look");
    expect(defocus(session, look, &in, &round, 0, NULL, NULL) == PETZVAL_OK, "a round disc");
    expect(petzval_look_set(look, "lens.blades", "5") == PETZVAL_OK, "blades");
    expect(petzval_look_set(look, "engine", "gather") == PETZVAL_OK, "an engine by its name");
    expect(defocus(session, look, &in, &pentagon, 0, NULL, NULL) == PETZVAL_OK, "a pentagon");
    expect(memcmp(&round, &pentagon, sizeof round) != 0, "a look changes the picture");
    expect(petzval_look_set(look, "lens.blade", "5") == PETZVAL_INVALID_ARGUMENT,
           "an unknown field is refused");
    expect(strstr(petzval_error_text(), "lens.blades") != NULL, "with the field that was meant");
    expect(petzval_look_json(look, &json) == PETZVAL_OK, "as JSON");
    const size_t bytes = strlen(json) + 1;
    char* kept = malloc(bytes);
    memcpy(kept, json, bytes);
    expect(petzval_look_from_json(kept, &again) == PETZVAL_OK, "and back");
    expect(petzval_look_json(again, &json) == PETZVAL_OK && strcmp(json, kept) == 0, "the same");
    free(kept);
    petzval_look_close(again);
    expect(petzval_look_from_json("{", &again) == PETZVAL_INVALID_FILE && again == NULL, "no JSON");
    petzval_look_close(look);
}

static void test_presets_have_names(void) {
    petzval_look* look = NULL;
    const char* json = NULL;
    int count = 0, is_night = 0;
    for (; petzval_preset_name(count); ++count)
        if (strcmp(petzval_preset_name(count), "night") == 0) is_night = 1;
    expect(count >= 9 && is_night && !petzval_preset_name(-1), "presets are listed");
    expect(petzval_look_from_preset("night", &look) == PETZVAL_OK, "a preset by name");
    expect(petzval_look_json(look, &json) == PETZVAL_OK && strstr(json, "\"blades\": 8"), "is its look");
    petzval_look_close(look);
    expect(petzval_look_from_preset("nigt", &look) == PETZVAL_INVALID_ARGUMENT && look == NULL, "not there");
    expect(strstr(petzval_error_text(), "did you mean night") != NULL, "with the name that was meant");
    expect(strstr(petzval_error_text(), "portrait, bubble") != NULL, "and all others");
    expect(petzval_look_from_preset(NULL, &look) == PETZVAL_INVALID_ARGUMENT, "no name");
}

static void test_what_is_wrong_is_said_and_nothing_is_written(petzval_session* session) {
    static picture in, out, before;
    petzval_look* look = NULL;
    petzval_control control = {0};
    const int stopped = 1;
    int asked = 0;
    paint(&in, 0);
    memset(&out, 7, sizeof out);
    before = out;
    expect(petzval_look_new(&look) == PETZVAL_OK &&
               petzval_look_set(look, "lens.name", "no such lens") == PETZVAL_OK,
           "a name is taken as it is");
    expect(defocus(session, look, &in, &out, 0, NULL, NULL) == PETZVAL_INVALID_ARGUMENT, "until it is used");
    expect(strstr(petzval_error_text(), "no such lens") != NULL, "the message names it");
    control.size = sizeof control;
    control.host = &asked;
    control.progress = ask_and_cancel;
    expect(defocus(session, NULL, &in, &out, 0, &control, NULL) == PETZVAL_CANCELLED && asked > 0,
           "cancelled");
    control.progress = NULL;
    control.stop = &stopped;
    expect(defocus(session, NULL, &in, &out, 0, &control, NULL) == PETZVAL_CANCELLED, "cancelled by a flag");
    expect(petzval_defocus(session, NULL, NULL, NULL, NULL, NULL) == PETZVAL_INVALID_ARGUMENT, "no shot");
    expect(petzval_defocus(NULL, NULL, NULL, NULL, NULL, NULL) == PETZVAL_INVALID_ARGUMENT, "no session");
    expect(memcmp(&out, &before, sizeof out) == 0, "nothing was written");
    petzval_look_close(look);
    petzval_look_close(NULL);
    petzval_session_close(NULL);
}

/* A pool of one thread, which counts. */
typedef struct pool {
    int runs, bodies;
} pool;
static int pool_width(void* host) {
    (void)host;
    return 3;
}
static void pool_run(void* host, int count, void (*body)(void* context, int index), void* context) {
    ((pool*)host)->runs += 1;
    for (int i = count - 1; i >= 0; --i) {
        body(context, i);
        ((pool*)host)->bodies += 1;
    }
}

static void test_threads_may_be_lent(petzval_session* own) {
    static picture in, out, lent_out;
    pool counted = {0, 0};
    petzval_workers workers = {0};
    petzval_session_settings settings = {0};
    petzval_session* session = NULL;
    paint(&in, 0);
    workers.size = sizeof workers;
    workers.host = &counted;
    workers.width = pool_width;
    settings.size = sizeof settings;
    settings.workers = &workers;
    expect(petzval_session_open(&settings, &session) == PETZVAL_INVALID_ARGUMENT && session == NULL,
           "workers that cannot run are refused");
    workers.run = pool_run;
    expect(petzval_session_open(&settings, &session) == PETZVAL_OK, "lent workers");
    expect(defocus(session, NULL, &in, &lent_out, 0, NULL, NULL) == PETZVAL_OK, "a frame by them");
    expect(counted.runs > 0 && counted.bodies > counted.runs, "they did the work");
    expect(defocus(own, NULL, &in, &out, 0, NULL, NULL) == PETZVAL_OK, "the same by our own");
    expect(memcmp(&out, &lent_out, sizeof out) == 0, "whoever works, the bits are the same");
    petzval_session_close(session);
}

static void test_a_region_is_a_crop_of_the_whole(petzval_session* session) {
    static picture in, out;
    enum { X = 14, Y = 11, W = 9, H = 6 };
    float part[H][W][4];
    petzval_pixels colour, into;
    const petzval_plane plane = radii_plane();
    petzval_shot shot = {0};
    petzval_control control = {0};
    int same = 1, margin = 0;
    paint(&in, 0);
    colour = pixels_of(&in, 0);
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
    into = pixels_of(&out, 0);
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_OK, "the whole");
    into.width = W;
    into.height = H;
    into.r = &part[0][0][0];
    into.g = &part[0][0][1];
    into.b = &part[0][0][2];
    into.a = &part[0][0][3];
    into.row_stride = sizeof part[0];
    control.size = sizeof control;
    control.region.x0 = X;
    control.region.y0 = Y;
    control.region.x1 = X + W;
    control.region.y1 = Y + H;
    expect(petzval_defocus(session, &shot, NULL, &control, &into, NULL) == PETZVAL_OK, "a region");
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x)
            same = same && memcmp(part[y][x], out.rgba[Y + y][X + x], sizeof part[0][0]) == 0;
    expect(same, "bit for bit");
    control.region.x1 += 1;
    expect(petzval_defocus(session, &shot, NULL, &control, &into, NULL) == PETZVAL_INVALID_ARGUMENT,
           "out of another size is refused");
    expect(
        petzval_region_margin_px(session, &shot, NULL, &margin) == PETZVAL_OK && margin > 20 && margin < 400,
        "it says what it looks at");
}

static int stop(void* host) {
    ++*(int*)host;
    return 1;
}

static void test_what_lies_behind_and_lights(petzval_session* session) {
    static picture in, out, bare;
    static uint64_t first[WIDTH * HEIGHT + 1];
    static petzval_deep_sample samples[WIDTH * HEIGHT];
    petzval_pixels colour, into = pixels_of(&out, 0);
    const petzval_plane plane = radii_plane();
    petzval_shot shot = {0};
    petzval_deep behind = {0};
    petzval_light light = {10.5f, 10.5f, 50, 50, 50, NAN, 4, 0};
    petzval_look* look = NULL;
    petzval_control control = {0};
    petzval_usage usage = {0};
    int asked = 0;
    paint(&in, 0);
    colour = pixels_of(&in, 0);
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const petzval_deep_sample s = {0.2f, 0.4f, 0.6f, 1, 9, 9};
        radii[i / WIDTH][i % WIDTH] = i % WIDTH < 24 ? -6 : 9;
        samples[i] = s;
        first[i + 1] = (uint64_t)i + 1;
    }
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_OK, "as seen");
    bare = out;
    behind.size = sizeof behind;
    behind.width = WIDTH;
    behind.height = HEIGHT;
    behind.first = first;
    behind.samples = samples;
    behind.sample_count = (uint64_t)WIDTH * HEIGHT;
    shot.behind = &behind;
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_OK, "with what lies behind");
    expect(memcmp(&out, &bare, sizeof out) != 0, "which is seen past the edge");
    behind.sample_count = 7;
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_INVALID_ARGUMENT,
           "samples that are not counted right are refused");
    shot.behind = NULL;
    shot.lights = &light;
    shot.light_count = 1;
    expect(petzval_look_new(&look) == PETZVAL_OK && petzval_look_set(look, "engine", "sprites") == PETZVAL_OK,
           "sprites");
    expect(petzval_defocus(session, &shot, look, NULL, &into, NULL) == PETZVAL_OK, "a light");
    control.size = sizeof control;
    control.host = &asked;
    control.cancelled = stop;
    expect(petzval_defocus(session, &shot, look, &control, &into, NULL) == PETZVAL_CANCELLED && asked > 0,
           "cancelled by being asked");
    usage.size = sizeof usage;
    expect(petzval_session_usage(session, &usage) == PETZVAL_OK && usage.lenses > 0, "what is kept");
    expect(petzval_session_trim(session, 0) == PETZVAL_OK &&
               petzval_session_usage(session, &usage) == PETZVAL_OK && usage.kept_bytes == 0,
           "may be let go");
    petzval_look_close(look);
}

static void test_a_mask_limits_the_effect(petzval_session* session) {
    static picture in, out, whole;
    static float shares[HEIGHT][WIDTH];
    petzval_pixels colour, into = pixels_of(&out, 0);
    const petzval_plane plane = radii_plane();
    petzval_plane mask = plane;
    petzval_shot shot = {0};
    paint(&in, 0);
    colour = pixels_of(&in, 0);
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_OK, "everywhere");
    whole = out;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) shares[y][x] = x < WIDTH / 2 ? 1.f : 0.f;
    mask.data = shares;
    shot.mask = &mask;
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_OK, "with a mask");
    for (int y = 0; y < HEIGHT; ++y)
        expect(memcmp(out.rgba[y], whole.rgba[y], sizeof out.rgba[y] / 2) == 0 &&
                   memcmp(out.rgba[y][WIDTH / 2], in.rgba[y][WIDTH / 2], sizeof out.rgba[y] / 2) == 0,
               "a row is blurred where the mask is 1, and as given where it is 0");
    expect(memcmp(&out, &whole, sizeof out) != 0, "which differ");
    mask.width = WIDTH - 1;
    expect(petzval_defocus(session, &shot, NULL, NULL, &into, NULL) == PETZVAL_INVALID_ARGUMENT,
           "a mask of another size is refused");
}

/* Wrong numbers of a host whose pictures are not there: who reads before comparing reads beyond them. */
static void test_all_is_compared_before_anything_is_read(petzval_session* session) {
    static picture in, out;
    static char long_name[1 << 21];
    static uint64_t first[WIDTH * HEIGHT + 1];
    static petzval_deep_sample sample;
    const float one[4] = {0};
    const petzval_pixels right = pixels_of(&in, 0), into = pixels_of(&out, 0);
    const petzval_plane plane = radii_plane();
    petzval_pixels colour = right, bad_out = into;
    petzval_plane bad = plane;
    petzval_deep deep = {0};
    petzval_light light = {0};
    petzval_shot shot = {0};
    petzval_look* look = NULL;
    const double aspects[] = {1e7, 1e9, 1e300, -1, NAN, INFINITY};
    const ptrdiff_t strides[] = {0, 3, -3, PTRDIFF_MAX, PTRDIFF_MIN};
    paint(&in, 0);
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
#define REFUSED(what, name)                                                                           \
    expect(petzval_defocus(session, &shot, NULL, NULL, &bad_out, NULL) == PETZVAL_INVALID_ARGUMENT && \
               strstr(petzval_error_text(), name) != NULL,                                            \
           what)
    for (int i = 0; i < 6; ++i) {
        shot.pixel_aspect = aspects[i];
        REFUSED("an aspect without end", "aspect");
    }
    shot.pixel_aspect = 0;
    for (int i = 0; i < 5; ++i) {
        colour.pixel_stride = strides[i];
        REFUSED("a pixel stride", "pixel_stride");
        colour = right;
        bad.row_stride = strides[i];
        shot.radii_px = &bad;
        REFUSED("a row stride", "row_stride");
        bad = plane;
        bad_out.row_stride = strides[i];
        REFUSED("a row stride of out", "out: row_stride");
        bad_out = into;
    }
    colour.width = 1 << 20;
    colour.height = 1 << 20;
    colour.r = colour.g = colour.b = colour.a = (void*)(size_t)one; /* of one pixel */
    REFUSED("a plane that is not of the colour's size", "radii_px is 48x32");
    bad.width = colour.width;
    bad.height = colour.height;
    shot.mask = &plane;
    REFUSED("a mask that is not", "mask is 48x32");
    shot.mask = NULL;
    REFUSED("out that is not", "out");
    colour = right;
    shot.radii_px = &plane;
    deep.size = sizeof deep;
    deep.width = WIDTH;
    deep.height = HEIGHT;
    deep.first = first;
    deep.samples = &sample;
    deep.sample_count = UINT64_MAX;
    first[(size_t)WIDTH * HEIGHT] = UINT64_MAX;
    shot.deep = &deep;
    REFUSED("samples without end", "deep: sample_count");
    shot.deep = NULL;
    shot.lights = &light;
    shot.light_count = UINT64_MAX;
    REFUSED("lights without end", "light_count");
    memset(long_name, 'x', sizeof long_name - 1);
    expect(petzval_look_new(&look) == PETZVAL_OK &&
               petzval_look_set(look, long_name, "1") == PETZVAL_INVALID_ARGUMENT,
           "an unknown field");
    expect(strlen(petzval_error_text()) < 1100, "a message that can be read");
    petzval_look_close(look);
}

static void test_numbers_of_threads(void) {
    const int counts[] = {-1, -2147483647, 2147483647, 1025};
    petzval_session_settings settings = {0};
    petzval_session* session = NULL;
    settings.size = sizeof settings;
    for (int i = 0; i < 4; ++i) {
        settings.threads = counts[i];
        expect(petzval_session_open(&settings, &session) == PETZVAL_INVALID_ARGUMENT && session == NULL &&
                   strstr(petzval_error_text(), "threads") != NULL,
               "a number of threads");
    }
}

/* A host that was built when settings held a size and nothing else. */
static void test_structs_of_older_hosts(void) {
    struct {
        size_t size;
        unsigned char beyond[256];
    } old;
    petzval_session* session = NULL;
    memset(&old, 0xff, sizeof old);
    old.size = sizeof old.size;
    expect(petzval_session_open((const petzval_session_settings*)&old, &session) == PETZVAL_OK,
           "what an old struct lacks is not read");
    petzval_session_close(session);
}

static void test_a_struct_without_a_size_is_refused(petzval_session* own) {
    static picture in, out;
    const petzval_pixels picture = pixels_of(&in, 0), into = pixels_of(&out, 0);
    const petzval_plane plane = radii_plane();
    const petzval_session_settings settings = {.threads = 2};
    const petzval_control control = {0};
    petzval_session* session = NULL;
    petzval_shot shot = {0};
    paint(&in, 0);
    shot.size = sizeof shot;
    shot.colour = &picture;
    shot.radii_px = &plane;
    expect(petzval_session_open(&settings, &session) == PETZVAL_INVALID_ARGUMENT && session == NULL &&
               strstr(petzval_error_text(), "sizeof") != NULL,
           "settings without a size are not the defaults");
    expect(petzval_defocus(own, &shot, NULL, &control, &into, NULL) == PETZVAL_INVALID_ARGUMENT &&
               strstr(petzval_error_text(), "sizeof") != NULL,
           "callbacks of a control without a size are not dropped");
}

static void test_devices(void) {
    petzval_session_settings settings = {0};
    petzval_session* session = NULL;
    settings.size = sizeof settings;
    settings.device = "auto";
    expect(petzval_session_open(&settings, &session) == PETZVAL_OK, "some device is always there");
    test_a_lamp_becomes_a_disc_of_the_same_light(session);
    petzval_session_close(session);
    settings.device = "gpu:99";
    expect(petzval_session_open(&settings, &session) != PETZVAL_OK && session == NULL, "this one is not");
    expect(strstr(petzval_error_text(), "session.device") != NULL, "and its field is named");
    if (petzval_device_name(1) != NULL) {
        settings.device = petzval_device_name(1);
        expect(petzval_session_open(&settings, &session) == PETZVAL_OK, "a second device");
        test_a_lamp_becomes_a_disc_of_the_same_light(session);
        petzval_session_close(session);
    }
}

static void test_names(void) {
    int engines = 0, lenses = 0;
    while (petzval_engine_name(engines) != NULL) ++engines;
    while (petzval_lens_name(lenses) != NULL) ++lenses;
    expect(engines >= 5 && lenses >= 40, "engines and lenses are listed");
    expect(petzval_engine_name(-1) == NULL && petzval_lens_name(lenses + 1) == NULL, "and end");
    expect(strcmp(petzval_device_name(0), "cpu") == 0, "the CPU is the first device");
    expect(strcmp(petzval_status_name(PETZVAL_CANCELLED), "cancelled") == 0, "statuses have names");
    expect(strcmp(petzval_status_name((petzval_status)99), "unknown") == 0, "others have none");
    expect(strlen(petzval_version()) >= 5, "a version");
}

int main(void) {
    petzval_session_settings settings = {0};
    petzval_session* session = NULL;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) radii[y][x] = 5;
    settings.size = sizeof settings;
    settings.threads = 2;
    expect(petzval_session_open(&settings, &session) == PETZVAL_OK, "a session");
    test_a_lamp_becomes_a_disc_of_the_same_light(session);
    test_rows_may_lie_bottom_up(session);
    test_a_frame_may_be_made_in_place(session);
    test_looks(session);
    test_presets_have_names();
    test_what_is_wrong_is_said_and_nothing_is_written(session);
    test_threads_may_be_lent(session);
    test_a_region_is_a_crop_of_the_whole(session);
    test_what_lies_behind_and_lights(session);
    test_a_mask_limits_the_effect(session);
    test_all_is_compared_before_anything_is_read(session);
    test_a_struct_without_a_size_is_refused(session);
    petzval_session_close(session);
    test_structs_of_older_hosts();
    test_numbers_of_threads();
    test_devices();
    test_names();
    printf("petzval %s: %d failures\n", petzval_version(), failures);
    return failures > 0;
}
