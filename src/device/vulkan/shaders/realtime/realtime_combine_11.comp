// The result as r11f_g11f_b10f.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define RESULT r11f_g11f_b10f
#include "realtime_combine.glsl"
