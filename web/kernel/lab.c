/* The calls of the lens lab: petzval_c.h with structs taken apart, so that a page passes numbers and text alone.
 * A call returns 1, or 0 with petzval_error_text() telling why. */
#include "petzval/petzval_c.h"

#include <stdlib.h>
#include <string.h>

/* The camera of all calls; 0: the number the lens was built for, focused at infinity. */
static petzval_camera camera;
static petzval_lens_mount mount;

void lab_camera(double focal_length_mm, double sensor_width_mm, double f_number, double focus_distance_m, int width,
                int height) {
    memset(&camera, 0, sizeof camera);
    camera.size = sizeof camera;
    camera.focal_length_mm = focal_length_mm;
    camera.sensor_width_mm = sensor_width_mm;
    camera.f_number = f_number;
    camera.focus_distance_m = focus_distance_m;
    memset(&mount, 0, sizeof mount);
    mount.size = sizeof mount;
    mount.camera = &camera;
    mount.width = width;
    mount.height = height;
}

static int same_text(const char* a, const char* b) { return a && b ? strcmp(a, b) == 0 : a == b; }

/* The lens asked for last stays open, so that another look of it needs no new rays. Null if refused. */
static petzval_lens* opened(const char* name, const char* text) {
    static petzval_lens* lens;
    static char *last_name, *last_text;
    if (lens && same_text(name, last_name) && same_text(text, last_text)) return lens;
    petzval_lens_close(lens);
    free(last_name);
    free(last_text);
    last_name = strdup(name);
    last_text = text ? strdup(text) : NULL;
    if ((text ? petzval_lens_from_memory(text, strlen(text), name, &lens) : petzval_lens_open(name, &lens)) != PETZVAL_OK)
        lens = NULL;
    return lens;
}

/* A lens by name, or, where text is not null, from the text of a lens file; used as look_json says. Null if refused. */
petzval_lens* lab_lens(const char* name, const char* text, const char* look_json) {
    petzval_lens* used = NULL;
    petzval_look* look = NULL;
    const petzval_lens* lens = opened(name, text);
    if (lens && petzval_look_from_json(look_json, &look) == PETZVAL_OK && petzval_lens_with(lens, look, &used) != PETZVAL_OK)
        used = NULL;
    petzval_look_close(look);
    return used;
}

void lab_close(petzval_lens* lens) { petzval_lens_close(lens); }

/* JSON for the caller, who frees it with lab_free(); null if refused. */
static char* taken(petzval_status status, petzval_text* text) {
    char* copy = status == PETZVAL_OK ? strdup(petzval_text_json(text)) : NULL;
    petzval_text_close(text);
    return copy;
}

char* lab_list(void) {
    petzval_text* text = NULL;
    return taken(petzval_lens_list(&text), text);
}

char* lab_facts(const petzval_lens* lens) {
    petzval_text* text = NULL;
    return taken(petzval_lens_facts(lens, &text), text);
}

char* lab_section(const petzval_lens* lens, double depth_m, double field_x, double field_y, int rays_across) {
    petzval_text* text = NULL;
    return taken(petzval_lens_section(lens, &mount, depth_m, field_x, field_y, rays_across, &text), text);
}

void lab_free(void* memory) { free(memory); }

/* Rows of r, g, b, a without gaps. */
static petzval_pixels rgba(float* out, int width, int height) {
    petzval_pixels pixels;
    memset(&pixels, 0, sizeof pixels);
    pixels.size = sizeof pixels;
    pixels.width = width;
    pixels.height = height;
    pixels.sample = PETZVAL_FLOAT;
    pixels.r = out;
    pixels.g = out + 1;
    pixels.b = out + 2;
    pixels.a = out + 3;
    pixels.pixel_stride = 4 * sizeof(float);
    pixels.row_stride = pixels.pixel_stride * width;
    return pixels;
}

static petzval_disc disc_at(double coc_radius_px, double field_x, double field_y) {
    petzval_disc disc;
    memset(&disc, 0, sizeof disc);
    disc.size = sizeof disc;
    disc.coc_radius_px = coc_radius_px;
    disc.field_x = field_x;
    disc.field_y = field_y;
    return disc;
}

/* Sides of a square that holds the disc; 0 if refused. */
int lab_disc_size(const petzval_lens* lens, double coc_radius_px, double field_x, double field_y) {
    const petzval_disc disc = disc_at(coc_radius_px, field_x, field_y);
    int size_px = 0;
    return petzval_lens_disc_size(lens, &mount, &disc, &size_px) == PETZVAL_OK ? size_px : 0;
}

/* Into size_px * size_px * 4 floats; the source stands in the middle pixel. The sides of the smallest square that holds
 * the disc, or 0 if refused. */
int lab_disc(const petzval_lens* lens, double coc_radius_px, double field_x, double field_y, float* out, int size_px) {
    const petzval_disc disc = disc_at(coc_radius_px, field_x, field_y);
    const petzval_pixels pixels = rgba(out, size_px, size_px);
    petzval_disc_report report;
    memset(&report, 0, sizeof report);
    report.size = sizeof report;
    return petzval_lens_disc(lens, &mount, &disc, &pixels, &report) == PETZVAL_OK ? report.needed_px : 0;
}

/* For eyes: even columns, each divided by its brightest channel; otherwise as `petzval lens table` writes it. */
static petzval_texture texture_of(int columns, double largest_coc_px, int for_eyes) {
    petzval_texture texture;
    memset(&texture, 0, sizeof texture);
    texture.size = sizeof texture;
    texture.columns = columns;
    texture.largest_coc_px = largest_coc_px;
    texture.rows_per_px = for_eyes ? 2 : 4;
    texture.even = for_eyes;
    texture.view = for_eyes;
    return texture;
}

int lab_texture_rows(const petzval_lens* lens, int columns, double largest_coc_px, int for_eyes) {
    const petzval_texture texture = texture_of(columns, largest_coc_px, for_eyes);
    int rows = 0;
    return petzval_lens_texture_rows(lens, &mount, &texture, &rows) == PETZVAL_OK ? rows : 0;
}

/* Into columns * rows * 4 floats; the rows that are used, or 0 if refused. */
int lab_texture(const petzval_lens* lens, int columns, double largest_coc_px, int for_eyes, float* out, int rows) {
    const petzval_texture texture = texture_of(columns, largest_coc_px, for_eyes);
    const petzval_pixels pixels = rgba(out, columns, rows);
    int used = 0;
    return petzval_lens_texture(lens, &mount, &texture, &pixels, NULL, &used) == PETZVAL_OK ? used : 0;
}
