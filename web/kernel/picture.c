/* A picture through a lens, for the lens lab: petzval_c.h with structs taken apart. A call returns 1, or 0 with
 * petzval_error_text() telling why. */
#include "petzval/petzval_c.h"

#include <stdlib.h>
#include <string.h>

/* Defined by the page (hand-over.js). */
void petzval_page_progress(double done);

static petzval_session *live, *still;
static petzval_pixels colour;
static petzval_plane depth;
static petzval_camera camera;
static petzval_deep behind;
static int has_behind;

static int report_progress(void* host, double done) {
    (void)host;
    petzval_page_progress(done);
    return 1;
}

/* Rows of r, g, b, a without gaps. */
static petzval_pixels rgba(float* pixels, int width, int height) {
    petzval_pixels given;
    memset(&given, 0, sizeof given);
    given.size = sizeof given;
    given.width = width, given.height = height;
    given.sample = PETZVAL_FLOAT;
    given.r = pixels, given.g = pixels + 1, given.b = pixels + 2, given.a = pixels + 3;
    given.pixel_stride = 4 * sizeof(float);
    given.row_stride = given.pixel_stride * width;
    return given;
}

/* The picture of all frames; the page's memory is read until the next shot. Hidden layers of the last one are gone. */
void picture_shot(float* pixels, float* depth_m, int width, int height) {
    colour = rgba(pixels, width, height);
    memset(&depth, 0, sizeof depth);
    depth.size = sizeof depth;
    depth.width = width, depth.height = height;
    depth.sample = PETZVAL_FLOAT;
    depth.data = depth_m;
    depth.pixel_stride = sizeof(float);
    depth.row_stride = depth.pixel_stride * width;
    has_behind = 0;
}

/* What visible surfaces hide: samples of pixel i are first[i]…first[i + 1] - 1. */
void picture_deep(const uint64_t* first, const petzval_deep_sample* samples, int count) {
    memset(&behind, 0, sizeof behind);
    behind.size = sizeof behind;
    behind.width = colour.width, behind.height = colour.height;
    behind.first = first, behind.samples = samples, behind.sample_count = (uint64_t)count;
    has_behind = 1;
}

static petzval_session* session_of(const char* device, petzval_session** kept) {
    petzval_session_settings settings;
    if (*kept) return *kept;
    memset(&settings, 0, sizeof settings);
    settings.size = sizeof settings;
    settings.threads = 1;
    settings.device = device;
    return petzval_session_open(&settings, kept) == PETZVAL_OK ? *kept : NULL;
}

static petzval_status frame(petzval_session* session, const petzval_look* look, float* out, petzval_report** report) {
    petzval_shot shot;
    petzval_control control;
    const petzval_pixels into = rgba(out, colour.width, colour.height);
    memset(&shot, 0, sizeof shot);
    shot.size = sizeof shot;
    shot.colour = &colour, shot.depth_m = &depth, shot.camera = &camera;
    shot.behind = has_behind ? &behind : NULL;
    memset(&control, 0, sizeof control);
    control.size = sizeof control;
    control.progress = report_progress;
    return petzval_defocus(session, &shot, look, &control, &into, report);
}

/* look_json as `petzval defocus --save-look` writes it; lens_text: that of a lens file in place of the look's lens, or
 * null. is_live: the page draws the plan of the engine "gather" that it is handed, and `out` stays empty. The report as
 * JSON, which the caller frees; null if refused. */
char* picture_frame(const char* look_json, const char* lens_name, const char* lens_text, double focal_length_mm,
                    double sensor_width_mm, double f_number, double focus_distance_m, int is_live, float* out) {
    petzval_session* session = is_live ? session_of("webgl", &live) : session_of("cpu", &still);
    petzval_look* look = NULL;
    petzval_lens* lens = NULL;
    petzval_report* report = NULL;
    char* told = NULL;
    memset(&camera, 0, sizeof camera);
    camera.size = sizeof camera;
    camera.focal_length_mm = focal_length_mm, camera.sensor_width_mm = sensor_width_mm;
    camera.f_number = f_number, camera.focus_distance_m = focus_distance_m;
    if (session && petzval_look_from_json(look_json, &look) == PETZVAL_OK &&
        (!lens_text || (petzval_lens_from_memory(lens_text, strlen(lens_text), lens_name, &lens) == PETZVAL_OK &&
                        petzval_look_set_lens(look, lens) == PETZVAL_OK)) &&
        frame(session, look, out, &report) == PETZVAL_OK)
        told = strdup(petzval_report_json(report));
    petzval_report_close(report);
    petzval_lens_close(lens);
    petzval_look_close(look);
    return told;
}

void picture_close(void* memory) { free(memory); }
