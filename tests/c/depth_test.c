/* Depth as renderers write it, through the C door: its kind, unit and range, and what counts as missing. */
#include "expect.h"

#include <math.h>
#include <petzval/petzval_c.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 48, HEIGHT = 32 };

static float colour[HEIGHT][WIDTH][4], metres[HEIGHT][WIDTH];

/* Bars of light in front of a slope, and a sky without depth. */
static void paint(void) {
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            for (int c = 0; c < 4; ++c) colour[y][x][c] = c == 3 ? 1.0f : (float)((x / 4 + y / 5 + c) % 3);
            metres[y][x] = y < 6 ? INFINITY : 2 + (float)x / 7 + (float)y / 31;
        }
}

static petzval_plane plane_of(float (*values)[WIDTH]) {
    petzval_plane plane = {0};
    plane.size = sizeof plane;
    plane.width = WIDTH, plane.height = HEIGHT;
    plane.sample = PETZVAL_FLOAT;
    plane.data = values;
    plane.pixel_stride = sizeof(float), plane.row_stride = sizeof values[0];
    return plane;
}

/* A frame of depth (or radii) with that meaning; null: planar metres. */
static petzval_status make(petzval_session* session, float (*depth)[WIDTH], float (*radii)[WIDTH],
                           const petzval_depth_meaning* meaning, float (*into)[WIDTH][4], petzval_report** report) {
    petzval_pixels from = {sizeof from, WIDTH, HEIGHT, PETZVAL_FLOAT, &colour[0][0][0], &colour[0][0][1],
                           &colour[0][0][2], &colour[0][0][3], sizeof colour[0][0], sizeof colour[0]};
    petzval_pixels to = from;
    const petzval_camera camera = {sizeof camera, 85, 36, 1.4, 2.5, 0};
    const petzval_plane depth_plane = plane_of(depth ? depth : metres), radii_plane = plane_of(radii ? radii : metres);
    petzval_shot shot = {0};
    shot.size = sizeof shot;
    shot.colour = &from, shot.camera = &camera, shot.depth_meaning = meaning;
    if (depth) shot.depth_m = &depth_plane;
    if (radii) shot.radii_px = &radii_plane;
    to.r = &into[0][0][0], to.g = &into[0][0][1], to.b = &into[0][0][2], to.a = &into[0][0][3];
    return petzval_defocus(session, &shot, NULL, NULL, &to, report);
}

static petzval_depth_meaning meaning_of(const char* kind, double unit_m, const double* range) {
    petzval_depth_meaning meaning = {0};
    meaning.size = sizeof meaning;
    meaning.kind = kind, meaning.unit_m = unit_m, meaning.range = range;
    return meaning;
}

static float expected[HEIGHT][WIDTH][4], found[HEIGHT][WIDTH][4];

/* The same picture from depth that `stored` writes in another way. */
static void expect_same(petzval_session* session, float (*stored)(float), const petzval_depth_meaning* meaning,
                        const char* what) {
    static float depth[HEIGHT][WIDTH];
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) depth[y][x] = stored(metres[y][x]);
    memset(found, 0, sizeof found);
    expect(make(session, depth, NULL, meaning, found, NULL) == PETZVAL_OK, what);
    expect(memcmp(expected, found, sizeof found) == 0, what);
}

static float as_it_is(float m) { return m; }
static float in_half_metres(float m) { return isinf(m) ? 0 : 2 * m; } /* exact; 0 is a miss */
static float downwards(float m) { return isinf(m) ? -1e10f : -m; }

static void test_metres_may_be_written_in_other_ways(petzval_session* session) {
    const petzval_depth_meaning planar = meaning_of(NULL, 0, NULL), half = meaning_of("planar", 0.5, NULL);
    expect(make(session, metres, NULL, NULL, expected, NULL) == PETZVAL_OK, "planar metres");
    expect(memcmp(expected, colour, sizeof colour) != 0, "the picture is blurred");
    expect_same(session, as_it_is, &planar, "a meaning without members is planar metres");
    expect_same(session, in_half_metres, &half, "half metres, with 0 for a miss");
    expect_same(session, downwards, &planar, "depth that counts downwards");
    petzval_report* report = NULL;
    static float depth[HEIGHT][WIDTH];
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) depth[y][x] = -metres[y][x];
    expect(make(session, depth, NULL, &planar, found, &report) == PETZVAL_OK, "a frame with a report");
    expect(strstr(petzval_report_json(report), "every depth is negative") != NULL, "its report warns");
    petzval_report_close(report);
}

static void test_radii_may_have_a_range(petzval_session* session) {
    static float shares[HEIGHT][WIDTH], radii[HEIGHT][WIDTH];
    const double range[2] = {-4, 12};
    const petzval_depth_meaning coc = meaning_of("coc-px", 0, range);
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            shares[y][x] = (float)(x % 17) / 16; /* radii are whole numbers */
            radii[y][x] = -4 + 16 * shares[y][x];
        }
    expect(make(session, NULL, radii, NULL, expected, NULL) == PETZVAL_OK, "radii");
    expect(make(session, shares, NULL, &coc, found, NULL) == PETZVAL_OK, "shares of two radii");
    expect(memcmp(expected, found, sizeof found) == 0, "both are the same picture");
}

static void expect_refused(petzval_session* session, float (*radii)[WIDTH], const petzval_depth_meaning* meaning,
                           const char* says) {
    memset(found, 0, sizeof found);
    memset(expected, 0, sizeof expected);
    expect(make(session, radii ? NULL : metres, radii, meaning, found, NULL) == PETZVAL_INVALID_ARGUMENT, says);
    expect(strstr(petzval_error_text(), says) != NULL, says);
    expect(memcmp(expected, found, sizeof found) == 0, "nothing is written");
}

static void test_a_meaning_that_is_none_is_refused(petzval_session* session) {
    const double range[2] = {3, 3};
    const petzval_depth_meaning other = meaning_of("z", 0, NULL), no_range = meaning_of("normalized", 0, NULL),
                                same = meaning_of("coc-px", 0, range), unit = meaning_of(NULL, -1, NULL);
    expect_refused(session, NULL, &other, "depth_meaning.kind");
    expect_refused(session, NULL, &no_range, "depth.range");
    expect_refused(session, NULL, &same, "two different radii");
    expect_refused(session, NULL, &unit, "unit_scale_m");
    expect_refused(session, metres, &unit, "depth_meaning is for depth_m");
}

int main(void) {
    petzval_session* session = NULL;
    expect(petzval_session_open(NULL, &session) == PETZVAL_OK, "a session");
    paint();
    test_metres_may_be_written_in_other_ways(session);
    test_radii_may_have_a_range(session);
    test_a_meaning_that_is_none_is_refused(session);
    petzval_session_close(session);
    if (failures == 0) printf("all right\n");
    return failures != 0;
}
