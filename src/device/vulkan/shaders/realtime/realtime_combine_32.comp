// The result as rgba32f.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define RESULT rgba32f
#include "realtime_combine.glsl"
