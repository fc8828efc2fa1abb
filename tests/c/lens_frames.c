/* Takes so many small frames with one look whose lens comes from a file, and prints a sum of their light: the lens is
 * opened as a handle, or with "by-name" for every frame. lens_once_test.py watches which files it opens.
 * Usage: lens_frames LENS_FILE FRAMES handle|by-name */
#include <petzval/petzval_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 24 };
static float rgba[SIZE][SIZE][4], out[SIZE][SIZE][4], radii[SIZE][SIZE];

static petzval_pixels pixels_of(float (*p)[SIZE][4]) {
    petzval_pixels view = {0};
    view.size = sizeof view;
    view.width = view.height = SIZE;
    view.r = p[0][0];
    view.g = (float*)view.r + 1;
    view.b = (float*)view.r + 2;
    view.a = (float*)view.r + 3;
    view.pixel_stride = 4 * sizeof(float);
    view.row_stride = sizeof p[0];
    return view;
}

static int choose_lens(petzval_look* look, const char* path, const char* how) {
    petzval_lens* lens = NULL;
    int failed;
    if (strcmp(how, "by-name") == 0) return petzval_look_set(look, "lens.name", path) != PETZVAL_OK;
    failed = petzval_lens_open(path, &lens) || petzval_look_set_lens(look, lens);
    petzval_lens_close(lens);
    return failed;
}

int main(int count, char** arguments) {
    const petzval_camera camera = {sizeof camera, 100, 36, 8, 2, 0};
    const petzval_pixels colour = pixels_of(rgba), into = pixels_of(out);
    petzval_plane plane = {0};
    petzval_shot shot = {0};
    petzval_session* session = NULL;
    petzval_look* look = NULL;
    double sum = 0;
    int frame, i;
    if (count != 4) return 2;
    rgba[8][8][0] = 10;
    plane.size = sizeof plane;
    plane.width = plane.height = SIZE;
    plane.data = radii;
    plane.pixel_stride = sizeof(float);
    plane.row_stride = sizeof radii[0];
    shot.size = sizeof shot;
    shot.colour = &colour;
    shot.radii_px = &plane;
    shot.camera = &camera;
    if (petzval_session_open(NULL, &session) || petzval_look_new(&look) ||
        choose_lens(look, arguments[1], arguments[3]))
        return fprintf(stderr, "%s\n", petzval_error_text()), 1;
    for (frame = 0; frame < atoi(arguments[2]); ++frame) {
        for (i = 0; i < SIZE * SIZE; ++i) radii[i / SIZE][i % SIZE] = 2 + 0.01f * (float)frame;
        if (petzval_defocus(session, &shot, look, NULL, &into, NULL))
            return fprintf(stderr, "%s\n", petzval_error_text()), 1;
        for (i = 0; i < SIZE * SIZE; ++i) sum += out[i / SIZE][i % SIZE][0];
    }
    printf("%.6f\n", sum);
    petzval_look_close(look);
    petzval_session_close(session);
    return 0;
}
