/* A host in C: reads a shot with all its layers, takes a frame through a lens file, writes it like the input.
 * Usage: shot_program SHOT.exr LENS_FILE FOCUS_M OUT.exr. tests/python/files_test.py compares its bits with others'. */
#include <petzval/petzval_files_c.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_LAYERS = 16 };

static int failed(const char* what, const char* why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return 1;
}

/* Packed floats, r, g, b, a, of the size of another picture. */
static petzval_pixels like(const petzval_pixels* other) {
    petzval_pixels made = {0};
    float* rgba = calloc((size_t)other->width * (size_t)other->height * 4, sizeof(float));
    made.size = sizeof made;
    made.width = other->width;
    made.height = other->height;
    made.r = rgba;
    made.g = rgba + 1;
    made.b = rgba + 2;
    made.a = rgba + 3;
    made.pixel_stride = 4 * sizeof(float);
    made.row_stride = made.pixel_stride * made.width;
    return made;
}

int main(int count, char** arguments) {
    static const char* all[] = {"all"};
    static petzval_layer layers[MOST_LAYERS];
    static petzval_pixels outs[MOST_LAYERS];
    static const petzval_layer* given[MOST_LAYERS];
    static const petzval_pixels* written[MOST_LAYERS];
    petzval_camera camera = {0};
    petzval_shot_source source = {0};
    petzval_shot_file* file = NULL;
    petzval_session* session = NULL;
    petzval_look* look = NULL;
    petzval_lens* lens = NULL;
    petzval_shot shot;
    petzval_pixels out;
    uint64_t i;
    if (count != 5) return 2;
    camera.size = sizeof camera;
    camera.focal_length_mm = 85;
    camera.sensor_width_mm = 36;
    camera.f_number = 2;
    camera.focus_distance_m = atof(arguments[3]);
    source.size = sizeof source;
    source.path = arguments[1];
    source.camera = &camera;
    source.layers = all;
    source.layer_count = 1;
    if (petzval_files_read_shot(&source, &file)) return failed("reading", petzval_files_error_text());
    if (petzval_session_open(NULL, &session) || petzval_look_new(&look) || petzval_lens_open(arguments[2], &lens) ||
        petzval_look_set_lens(look, lens))
        return failed("opening", petzval_error_text());
    shot = *petzval_files_shot(file);
    if (shot.layer_count > MOST_LAYERS) return failed("layers", "more than this program has room for");
    for (i = 0; i < shot.layer_count; ++i) {
        layers[i] = *shot.layers[i];
        outs[i] = like(shot.colour);
        layers[i].out = &outs[i];
        given[i] = &layers[i];
        written[i] = &outs[i];
    }
    shot.layers = given;
    out = like(shot.colour);
    if (petzval_defocus(session, &shot, look, NULL, &out, NULL)) return failed("a frame", petzval_error_text());
    if (petzval_files_write_like(file, &out, written, shot.layer_count, arguments[4]))
        return failed("writing", petzval_files_error_text());
    for (i = 0; i < shot.layer_count; ++i) free(outs[i].r);
    free(out.r);
    petzval_lens_close(lens);
    petzval_look_close(look);
    petzval_session_close(session);
    petzval_files_close(file);
    return 0;
}
