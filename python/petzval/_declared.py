"""Structs and prototypes of libpetzval.so. Written by tools/c_api.py from the headers; not edited."""
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_size_t,
                    c_ssize_t, c_uint64, c_void_p)


PETZVAL_OK = 0
PETZVAL_INVALID_ARGUMENT = 1
PETZVAL_INVALID_FILE = 2
PETZVAL_UNSUPPORTED = 3
PETZVAL_OUTPUT_FAILED = 4
PETZVAL_OUT_OF_MEMORY = 5
PETZVAL_CANCELLED = 6
PETZVAL_INTERNAL = 7
PETZVAL_READ_FAILED = 8

PETZVAL_FLOAT = 0
PETZVAL_HALF = 1


class petzval_text(Structure):
    """A handle."""


class petzval_session(Structure):
    """A handle."""


class petzval_look(Structure):
    """A handle."""


class petzval_report(Structure):
    """A handle."""


class petzval_lens(Structure):
    """A handle."""


class petzval_shot_file(Structure):
    """A handle."""


class petzval_files_run(Structure):
    """A handle."""


class petzval_workers(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("host", c_void_p),
        ("width", CFUNCTYPE(c_int, c_void_p)),
        ("run", CFUNCTYPE(None, c_void_p, c_int, c_void_p, c_void_p)),
    ]


class petzval_session_settings(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("threads", c_int),
        ("max_memory_bytes", c_uint64),
        ("kernel_folder", c_char_p),
        ("workers", POINTER(petzval_workers)),
        ("device", c_char_p),
    ]


class petzval_usage(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("kept_bytes", c_uint64),
        ("lenses", c_int),
    ]


class petzval_pixels(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("width", c_int),
        ("height", c_int),
        ("sample", c_int),
        ("r", c_void_p),
        ("g", c_void_p),
        ("b", c_void_p),
        ("a", c_void_p),
        ("pixel_stride", c_ssize_t),
        ("row_stride", c_ssize_t),
    ]


class petzval_plane(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("width", c_int),
        ("height", c_int),
        ("sample", c_int),
        ("data", c_void_p),
        ("pixel_stride", c_ssize_t),
        ("row_stride", c_ssize_t),
    ]


class petzval_rect(Structure):
    _fields_ = [
        ("x0", c_int),
        ("y0", c_int),
        ("x1", c_int),
        ("y1", c_int),
    ]


class petzval_camera(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("focal_length_mm", c_double),
        ("sensor_width_mm", c_double),
        ("f_number", c_double),
        ("focus_distance_m", c_double),
        ("thin_lens", c_int),
    ]


class petzval_deep_sample(Structure):
    _fields_ = [
        ("r", c_float),
        ("g", c_float),
        ("b", c_float),
        ("a", c_float),
        ("depth", c_float),
        ("depth_back", c_float),
    ]


class petzval_deep(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("width", c_int),
        ("height", c_int),
        ("first", POINTER(c_uint64)),
        ("samples", POINTER(petzval_deep_sample)),
        ("sample_count", c_uint64),
    ]


class petzval_light(Structure):
    _fields_ = [
        ("x", c_float),
        ("y", c_float),
        ("r", c_float),
        ("g", c_float),
        ("b", c_float),
        ("depth_m", c_float),
        ("radius_px", c_float),
        ("diameter_px", c_float),
    ]


class petzval_layer(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("colour", POINTER(petzval_pixels)),
        ("is_matte", c_int),
        ("spectrum", c_char_p),
        ("out", POINTER(petzval_pixels)),
    ]


class petzval_depth_meaning(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("kind", c_char_p),
        ("unit_m", c_double),
        ("range", POINTER(c_double)),
    ]


class petzval_shot(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("colour", POINTER(petzval_pixels)),
        ("depth_m", POINTER(petzval_plane)),
        ("radii_px", POINTER(petzval_plane)),
        ("camera", POINTER(petzval_camera)),
        ("display_window", petzval_rect),
        ("data_window", petzval_rect),
        ("pixel_aspect", c_double),
        ("deep", POINTER(petzval_deep)),
        ("behind", POINTER(petzval_deep)),
        ("holdout", POINTER(petzval_deep)),
        ("lights", POINTER(petzval_light)),
        ("light_count", c_uint64),
        ("mask", POINTER(petzval_plane)),
        ("layers", POINTER(POINTER(petzval_layer))),
        ("layer_count", c_uint64),
        ("depth_meaning", POINTER(petzval_depth_meaning)),
    ]


class petzval_control(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("host", c_void_p),
        ("progress", CFUNCTYPE(c_int, c_void_p, c_double)),
        ("cancelled", CFUNCTYPE(c_int, c_void_p)),
        ("region", petzval_rect),
        ("stop", POINTER(c_int)),
    ]


class petzval_lens_mount(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("camera", POINTER(petzval_camera)),
        ("width", c_int),
        ("height", c_int),
        ("pixel_aspect", c_double),
    ]


class petzval_disc(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("coc_radius_px", c_double),
        ("field_x", c_double),
        ("field_y", c_double),
        ("raw", c_int),
    ]


class petzval_disc_report(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("needed_px", c_int),
        ("lost_share", c_double),
    ]


class petzval_texture(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("columns", c_int),
        ("largest_coc_px", c_double),
        ("even", c_int),
        ("rows_per_px", c_int),
        ("raw", c_int),
        ("view", c_int),
        ("threads", c_int),
    ]


class petzval_atlas(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("largest_coc_px", c_double),
        ("zones", c_int),
    ]


class petzval_codes(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("data", c_void_p),
        ("row_stride", c_ssize_t),
        ("width", c_int),
        ("height", c_int),
        ("bits", c_int),
        ("exposure_stops", c_double),
        ("contrast", c_double),
        ("tone", c_char_p),
        ("transfer", c_char_p),
        ("no_dither", c_int),
        ("window", petzval_rect),
    ]


class petzval_shot_source(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("path", c_char_p),
        ("layer", c_char_p),
        ("view_name", c_char_p),
        ("depth_file", c_char_p),
        ("depth_channel", c_char_p),
        ("depth_kind", c_char_p),
        ("depth_unit_m", c_double),
        ("behind", c_char_p),
        ("holdout", c_char_p),
        ("mask", c_char_p),
        ("lights", c_char_p),
        ("layers", POINTER(c_char_p)),
        ("layer_count", c_uint64),
        ("camera", POINTER(petzval_camera)),
        ("threads", c_int),
        ("max_memory_bytes", c_uint64),
        ("depth_range", POINTER(c_double)),
    ]


class petzval_run_host(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("host", c_void_p),
        ("frame_done", CFUNCTYPE(c_int, c_void_p, c_int, c_char_p, c_char_p, c_char_p)),
        ("stop", POINTER(c_int)),
    ]


# Name: type of the result, types of the arguments.
PROTOTYPES = {
    "petzval_error_text": (c_char_p, []),
    "petzval_status_name": (c_char_p, [c_int]),
    "petzval_version": (c_char_p, []),
    "petzval_text_json": (c_char_p, [POINTER(petzval_text)]),
    "petzval_text_close": (None, [POINTER(petzval_text)]),
    "petzval_session_open": (c_int, [POINTER(petzval_session_settings), POINTER(POINTER(petzval_session))]),
    "petzval_session_close": (None, [POINTER(petzval_session)]),
    "petzval_session_usage": (c_int, [POINTER(petzval_session), POINTER(petzval_usage)]),
    "petzval_session_trim": (c_int, [POINTER(petzval_session), c_uint64]),
    "petzval_engine_name": (c_char_p, [c_int]),
    "petzval_lens_name": (c_char_p, [c_int]),
    "petzval_preset_name": (c_char_p, [c_int]),
    "petzval_device_name": (c_char_p, [c_int]),
    "petzval_look_new": (c_int, [POINTER(POINTER(petzval_look))]),
    "petzval_look_from_json": (c_int, [c_char_p, POINTER(POINTER(petzval_look))]),
    "petzval_look_from_preset": (c_int, [c_char_p, POINTER(POINTER(petzval_look))]),
    "petzval_look_set": (c_int, [POINTER(petzval_look), c_char_p, c_char_p]),
    "petzval_look_json": (c_int, [POINTER(petzval_look), POINTER(c_char_p)]),
    "petzval_look_close": (None, [POINTER(petzval_look)]),
    "petzval_defocus": (c_int, [POINTER(petzval_session), POINTER(petzval_shot), POINTER(petzval_look),
        POINTER(petzval_control), POINTER(petzval_pixels), POINTER(POINTER(petzval_report))]),
    "petzval_region_margin_px": (c_int, [POINTER(petzval_session), POINTER(petzval_shot),
        POINTER(petzval_look), POINTER(c_int)]),
    "petzval_report_json": (c_char_p, [POINTER(petzval_report)]),
    "petzval_report_close": (None, [POINTER(petzval_report)]),
    "petzval_lens_open": (c_int, [c_char_p, POINTER(POINTER(petzval_lens))]),
    "petzval_lens_from_memory": (c_int, [c_void_p, c_size_t, c_char_p, POINTER(POINTER(petzval_lens))]),
    "petzval_lens_with": (c_int, [POINTER(petzval_lens), POINTER(petzval_look),
        POINTER(POINTER(petzval_lens))]),
    "petzval_lens_close": (None, [POINTER(petzval_lens)]),
    "petzval_lens_title": (c_char_p, [POINTER(petzval_lens)]),
    "petzval_look_set_lens": (c_int, [POINTER(petzval_look), POINTER(petzval_lens)]),
    "petzval_lens_list": (c_int, [POINTER(POINTER(petzval_text))]),
    "petzval_lens_facts": (c_int, [POINTER(petzval_lens), POINTER(POINTER(petzval_text))]),
    "petzval_lens_curves": (c_int, [POINTER(petzval_lens), POINTER(POINTER(petzval_text))]),
    "petzval_lens_section": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount), c_double, c_double,
        c_double, c_int, POINTER(POINTER(petzval_text))]),
    "petzval_lens_disc_size": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount),
        POINTER(petzval_disc), POINTER(c_int)]),
    "petzval_lens_disc": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount), POINTER(petzval_disc),
        POINTER(petzval_pixels), POINTER(petzval_disc_report)]),
    "petzval_lens_texture_rows": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount),
        POINTER(petzval_texture), POINTER(c_int)]),
    "petzval_lens_texture": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount),
        POINTER(petzval_texture), POINTER(petzval_pixels), POINTER(c_double), POINTER(c_int)]),
    "petzval_lens_atlas_bytes": (c_int, [POINTER(petzval_atlas), POINTER(c_size_t)]),
    "petzval_lens_atlas": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount), POINTER(petzval_atlas),
        c_void_p, c_size_t, POINTER(POINTER(petzval_text))]),
    "petzval_lens_buffer_bytes": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount), c_char_p,
        POINTER(c_size_t)]),
    "petzval_lens_buffer": (c_int, [POINTER(petzval_lens), POINTER(petzval_lens_mount), c_char_p, c_void_p,
        c_size_t]),
    "petzval_check_lens_buffer": (c_int, [c_void_p, c_size_t]),
    "petzval_defocus_stage": (c_int, [POINTER(petzval_session), c_char_p, POINTER(petzval_shot),
        POINTER(petzval_look), POINTER(petzval_control), POINTER(petzval_pixels),
        POINTER(POINTER(petzval_report))]),
    "petzval_defocus_codes": (c_int, [POINTER(petzval_session), POINTER(petzval_shot), POINTER(petzval_look),
        POINTER(petzval_control), POINTER(petzval_codes), POINTER(POINTER(petzval_report))]),
    "petzval_compare": (c_int, [POINTER(petzval_pixels), POINTER(petzval_pixels), POINTER(petzval_plane),
        c_double, POINTER(POINTER(petzval_text))]),
}
# The same of libpetzval-files.so.
FILES_PROTOTYPES = {
    "petzval_files_error_text": (c_char_p, []),
    "petzval_files_read_shot": (c_int, [POINTER(petzval_shot_source), POINTER(POINTER(petzval_shot_file))]),
    "petzval_files_inspect": (c_int, [c_char_p, POINTER(POINTER(petzval_shot_file))]),
    "petzval_files_make_scene": (c_int, [c_char_p, c_int, c_int, c_uint64, c_int,
        POINTER(POINTER(petzval_shot_file))]),
    "petzval_files_shot": (POINTER(petzval_shot), [POINTER(petzval_shot_file)]),
    "petzval_files_truth": (POINTER(petzval_pixels), [POINTER(petzval_shot_file)]),
    "petzval_files_json": (c_char_p, [POINTER(petzval_shot_file)]),
    "petzval_files_write_like": (c_int, [POINTER(petzval_shot_file), POINTER(petzval_pixels),
        POINTER(POINTER(petzval_pixels)), c_uint64, c_char_p]),
    "petzval_files_close": (None, [POINTER(petzval_shot_file)]),
    "petzval_files_run_open": (c_int, [POINTER(petzval_session_settings), c_char_p, POINTER(petzval_run_host),
        POINTER(POINTER(petzval_files_run))]),
    "petzval_files_run_plan": (c_int, [POINTER(petzval_files_run)]),
    "petzval_files_run_frames": (c_int, [POINTER(petzval_files_run), POINTER(POINTER(c_int)),
        POINTER(c_uint64)]),
    "petzval_files_run_all": (c_int, [POINTER(petzval_files_run)]),
    "petzval_files_run_failed": (c_int, [POINTER(petzval_files_run), POINTER(POINTER(c_int)),
        POINTER(c_uint64)]),
    "petzval_files_run_close": (None, [POINTER(petzval_files_run)]),
}
