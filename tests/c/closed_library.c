/* A host opens libpetzval.so by its path, makes a frame and closes the library, whose threads must not crash
 * it.
 *
 * Usage: closed_library LIBPETZVAL.so
 */
#define _POSIX_C_SOURCE 199309L
#include <dlfcn.h>
#include <petzval/petzval_c.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 256, HEIGHT = 256 };

static float rgba[HEIGHT][WIDTH][4], radii[HEIGHT][WIDTH];

/* Pointers of dlsym are of objects: ISO C converts them to functions through memory only. */
#define TAKE(library, name)                                  \
    do {                                                     \
        void* found = dlsym(library, #name);                 \
        memcpy(&host_##name, &found, sizeof host_##name);    \
        if (!found) return printf("%s is missing\n", #name); \
    } while (0)

static int make_frame(void* library) {
    petzval_status (*host_petzval_session_open)(const petzval_session_settings*, petzval_session**);
    void (*host_petzval_session_close)(petzval_session*);
    petzval_status (*host_petzval_defocus)(petzval_session*, const petzval_shot*, const petzval_look*,
                                           const petzval_control*, const petzval_pixels*, petzval_report**);
    TAKE(library, petzval_session_open);
    TAKE(library, petzval_session_close);
    TAKE(library, petzval_defocus);
    petzval_pixels pixels = {0};
    pixels.size = sizeof pixels;
    pixels.width = WIDTH, pixels.height = HEIGHT;
    pixels.sample = PETZVAL_FLOAT;
    pixels.r = rgba[0][0], pixels.g = rgba[0][0] + 1, pixels.b = rgba[0][0] + 2, pixels.a = rgba[0][0] + 3;
    pixels.pixel_stride = sizeof rgba[0][0], pixels.row_stride = sizeof rgba[0];
    petzval_plane plane = {0};
    plane.size = sizeof plane;
    plane.width = WIDTH, plane.height = HEIGHT;
    plane.data = radii[0], plane.pixel_stride = sizeof(float), plane.row_stride = sizeof radii[0];
    petzval_shot shot = {0};
    shot.size = sizeof shot;
    shot.colour = &pixels, shot.radii_px = &plane;
    petzval_session* session = NULL;
    if (host_petzval_session_open(NULL, &session) != PETZVAL_OK) return printf("no session\n");
    const petzval_status status = host_petzval_defocus(session, &shot, NULL, NULL, &pixels, NULL);
    host_petzval_session_close(session);
    return status == PETZVAL_OK ? 0 : printf("status %d\n", (int)status);
}

int main(int count, char** words) {
    void* library = count == 2 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) return printf("cannot open the library\n");
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            radii[y][x] = 5;
            rgba[y][x][0] = rgba[y][x][1] = rgba[y][x][2] = rgba[y][x][3] = 1;
        }
    if (make_frame(library)) return 1;
    dlclose(library);
    const struct timespec a_while = {0, 300000000};
    nanosleep(&a_while, NULL);
    return 0;
}
